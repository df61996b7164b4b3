#pragma once

#include "Shape.h"
#include "sinew/MeshIO/TriangleFile.h"

#include <functional>
#include <string>
#include <vector>

namespace sinew::repair {

enum class Csg { Union, Difference, Intersection };

/// An operation on one level set.
struct Change {
  bool needsDistance = false;  ///< the level set must be a signed distance before
  double growth = 0;           ///< by which the shape's box may grow on every side, mm
  std::function<DenseLevelSet(const DenseLevelSet&)> apply;
};

/// Makes shapes of shapes. One engine computes level sets, the other one only guesses boxes and volumes.
class ShapeEngine {
 public:
  explicit ShapeEngine(const Segmentation& input) : input_(input) {}
  virtual ~ShapeEngine() = default;

  /// A tissue of the input, as it was read.
  ShapePtr tissue(int index) const;
  ShapePtr solid(Solid solid, double blend) const;

  virtual ShapePtr mesh(const TriangleMesh& mesh) = 0;
  virtual ShapePtr combined(Csg operation, const ShapePtr& a, const ShapePtr& b, double blend) = 0;
  virtual ShapePtr changed(const ShapePtr& shape, const Change& change) = 0;
  /// The pieces, largest first.
  virtual std::vector<ShapePtr> components(const ShapePtr& shape) = 0;
  /// Moved, and perhaps scaled evenly.
  virtual ShapePtr moved(const ShapePtr& shape, const Eigen::Affine3d& motion) = 0;

  virtual double volume(const ShapePtr& shape) = 0;  ///< mm^3
  /// What is known of a shape without making a level set for it.
  virtual std::optional<ShapeSummary> summary(const ShapePtr& shape) = 0;
  virtual Eigen::AlignedBox3d bounds(const ShapePtr& shape) = 0;  ///< LPS mm
  virtual Eigen::Vector3d centroid(const ShapePtr& shape) = 0;    ///< LPS mm

 protected:
  const Segmentation& input_;
};

/// Box of all voxels, faces included, LPS mm.
Eigen::AlignedBox3d physicalBox(const ImageGeometry& geometry, const VoxelBox& voxels);

/// What a shape made of others inherits: name and origin of the first one that has them.
Shape descendant(const ShapePtr& a, const ShapePtr& b = nullptr);

/// For --check: computes nothing.
std::unique_ptr<ShapeEngine> makeEstimatingEngine(const Segmentation& input);

}  // namespace sinew::repair
