#include "MeasureFidelity.h"

#include "VoxelMask.h"
#include "sinew/Segmentation/LabelComponents.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

/// Largest value and root mean square of the distances of a growing set of points from the target.
class Deviation {
 public:
  explicit Deviation(const TargetSurface& target)
      : phi_(target.phi),
        toLocal_(target.frame.inverse()),
        lowest_(std::min(target.offset, 0.)),
        highest_(std::max(target.offset, 0.)) {}
  /// @param x  LPS mm
  void add(const Eigen::Vector3d& x) {
    const double phi = phi_.value(toLocal_ * x);
    const double distance = std::max({phi - highest_, lowest_ - phi, 0.});
    if (distance > max_) place_ = x;
    max_ = std::max(max_, distance);
    squares_ += distance * distance;
    ++points_;
  }
  double max() const { return max_; }
  const Eigen::Vector3d& place() const { return place_; }  ///< of the largest value
  double rms() const { return points_ > 0 ? std::sqrt(squares_ / static_cast<double>(points_)) : 0; }

 private:
  const SignedDistance& phi_;
  Eigen::Isometry3d toLocal_;
  double lowest_, highest_;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();
  double max_ = 0, squares_ = 0;
  std::int64_t points_ = 0;
};

void measureSurface(const TetMesh& mesh, const std::vector<Triangle>& triangles, const TargetSurface& target,
                    Fidelity& fidelity) {
  std::vector<bool> onBoundary(mesh.nodes.size());
  Deviation deviation(target);
  for (const Triangle& triangle : triangles)
    for (const std::int32_t node : triangle) {
      if (!onBoundary[node]) deviation.add(mesh.nodes[node]);
      onBoundary[node] = true;
    }
  fidelity.maxBoundaryPhi = deviation.max();
  for (const Triangle& triangle : triangles) {
    const Eigen::Vector3d corners[]{mesh.nodes[triangle[0]], mesh.nodes[triangle[1]],
                                    mesh.nodes[triangle[2]]};
    deviation.add((corners[0] + corners[1] + corners[2]) / 3);
    for (int e = 0; e < 3; ++e) {
      const int next = (e + 1) % 3;
      // Each edge belongs to two triangles, in opposite directions.
      if (triangle[e] < triangle[next]) deviation.add((corners[e] + corners[next]) / 2);
    }
  }
  fidelity.surfaceRms = deviation.rms();
  fidelity.surfaceMax = deviation.max();
  fidelity.surfaceMaxPlace = deviation.place();
}

}  // namespace

double meshVolume(const TetMesh& mesh) {
  double sixfold = 0;
  for (const auto& [a, b, c, d] : mesh.tets) {
    const Eigen::Vector3d& x = mesh.nodes[a];
    sixfold += (mesh.nodes[b] - x).cross(mesh.nodes[c] - x).dot(mesh.nodes[d] - x);
  }
  return sixfold / 6;
}

double boundaryArea(const TetMesh& mesh) {
  double twofold = 0;
  for (const auto& [a, b, c] : meshBoundary(mesh).triangles)
    twofold += (mesh.nodes[b] - mesh.nodes[a]).cross(mesh.nodes[c] - mesh.nodes[a]).norm();
  return twofold / 2;
}

FidelityReport measureFidelity(const TetMesh& mesh, const std::vector<Triangle>& boundary,
                               const TargetSurface& target, const LevelSetFromLabelsReport& volumes,
                               const Segmentation& segmentation, const Tissue& tissue) {
  FidelityReport report;
  report.fidelity.surfaceOffset = target.offset;
  measureSurface(mesh, boundary, target, report.fidelity);
  report.fidelity.volume = meshVolume(mesh);
  report.fidelity.labelVolume = volumes.labelVolume;
  report.fidelity.levelSetVolume = volumes.levelSetVolume;

  const VoxelMask covered = voxelsInMesh(mesh, segmentation.geometry.indexToPhysical().inverse());
  const LabelComponents pieces = labelComponents(segmentation, tissue);
  std::vector<bool> kept(pieces.voxels.size());
  std::int64_t shared = 0;
  std::size_t voxel = 0;
  for (int z = pieces.box.lower.z(); z < pieces.box.upper.z(); ++z)
    for (int y = pieces.box.lower.y(); y < pieces.box.upper.y(); ++y)
      for (int x = pieces.box.lower.x(); x < pieces.box.upper.x(); ++x) {
        const std::int32_t piece = pieces.ids[voxel++];
        if (piece < 0 || !covered.test({x, y, z})) continue;
        kept[piece] = true;
        ++shared;
      }
  const std::int64_t both = tissue.voxels + covered.count();
  report.fidelity.dice = both > 0 ? 2. * static_cast<double>(shared) / static_cast<double>(both) : 0;
  for (std::size_t piece = 0; piece < kept.size(); ++piece) {
    if (kept[piece]) continue;
    ++report.lost.components;
    report.lost.volume += static_cast<double>(pieces.voxels[piece]) * segmentation.geometry.voxelVolume();
  }
  return report;
}

}  // namespace sinew
