#pragma once

#include "ShapeEngine.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace sinew::repair {

/// Computes level sets, all on the common lattice of the scan: of tissues when they are needed, of solids as
/// far as they are seen.
class ComputingEngine : public ShapeEngine {
 public:
  ComputingEngine(const Segmentation& input, const RepairOptions& options);

  /// Lets go of shapes that nobody can reach; called when room is short.
  void setCollector(std::function<void()> collect) { collect_ = std::move(collect); }

  ShapePtr mesh(const TriangleMesh& mesh) override;
  ShapePtr combined(Csg operation, const ShapePtr& a, const ShapePtr& b, double blend) override;
  ShapePtr changed(const ShapePtr& shape, const Change& change) override;
  std::vector<ShapePtr> components(const ShapePtr& shape) override;
  ShapePtr moved(const ShapePtr& shape, const Eigen::Affine3d& motion) override;
  double volume(const ShapePtr& shape) override;
  std::optional<ShapeSummary> summary(const ShapePtr& shape) override;
  Eigen::AlignedBox3d bounds(const ShapePtr& shape) override;
  Eigen::Vector3d centroid(const ShapePtr& shape) override;

  /// The level set of a shape; of an infinite one as far as the image goes.
  LevelSetPtr levelSetOf(const ShapePtr& shape);
  /// The same as a signed distance.
  LevelSetPtr distanceOf(const ShapePtr& shape);
  /// The level set of a tissue as it was read.
  LevelSetPtr tissueLevelSet(int index);
  double spacing() const { return lattice_.spacing; }

 private:
  /// As far as it can be seen in a box, with a band of at least `band`.
  LevelSetPtr sampled(const ShapePtr& shape, const Eigen::AlignedBox3d& within, double band);
  Eigen::AlignedBox3d finiteBox(const ShapePtr& shape, const ShapePtr& other = nullptr) const;
  ShapePtr made(Shape shape, DenseLevelSet levelSet, bool distance);

  /// Takes account of a level set that a shape keeps.
  LevelSetPtr held(DenseLevelSet levelSet);
  /// @throws ScriptError when level sets of so many bytes do not fit beside those that are held
  void makeRoom(double bytes);
  void makeRoomFor(const Eigen::AlignedBox3d& box);

  SampleLattice lattice_;
  double smoothingVoxels_;
  double smoothingTime_;  ///< mm^2
  double band_;           ///< mm
  std::int64_t limit_;
  std::shared_ptr<std::int64_t> held_ =
      std::make_shared<std::int64_t>(0);  ///< bytes; shapes may outlive this
  std::function<void()> collect_;
  std::vector<LevelSetPtr> tissues_;
  std::vector<std::optional<ShapeSummary>> tissueSummaries_;
  Eigen::AlignedBox3d image_;  ///< LPS mm
};

}  // namespace sinew::repair
