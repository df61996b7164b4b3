#include "SavedVoxels.h"

#include "sinew/LevelSet/VoxelsInside.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sinew::repair {
namespace {

/// Up to this difference two level sets are the same, samples.
constexpr double kSame = 0.05;
/// Beyond this distance from both surfaces only the side counts, samples.
constexpr double kNear = 1.5;

VoxelBox around(const VoxelBox& a, const VoxelBox& b) {
  if (a.empty()) return b;
  return b.empty() ? a : VoxelBox{a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

/// phi at a voxel of the image, clamped to +-limit; +limit outside of the box.
float phiAt(const PhiAtVoxels& field, const Eigen::Vector3i& voxel, float limit) {
  if ((voxel.array() < field.box.lower.array()).any() || (voxel.array() >= field.box.upper.array()).any())
    return limit;
  const Eigen::Vector3i index = voxel - field.box.lower;
  return std::clamp(field.phi(index.x(), index.y(), index.z()), -limit, limit);
}

/// Calls inside(voxel) for every voxel of a box.
template <class Inside>
VoxelSet voxelsWhere(const VoxelBox& box, const Inside& inside) {
  VoxelSet voxels{box, {}};
  if (box.empty()) return voxels;
  voxels.inside = DenseMask(box.upper - box.lower);
  const Eigen::Vector3i& size = voxels.inside.size;
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        voxels.inside(i, j, k) = inside(box.lower + Eigen::Vector3i(i, j, k));
  });
  return voxels;
}

}  // namespace

VoxelSet savedVoxels(const Segmentation& input, const Saving& saving, ComputingEngine& engine) {
  const Shape& shape = *saving.shape;
  const int old = shape.origin >= 0 ? shape.origin : saving.tissue;
  if (shape.untouched) return voxelsOf(input, input.tissues[static_cast<std::size_t>(old)]);
  const PhiAtVoxels after = phiAtVoxels(*engine.levelSetOf(saving.shape), input.geometry);
  if (old < 0)
    return voxelsWhere(after.box, [&](const Eigen::Vector3i& voxel) { return phiAt(after, voxel, 1) < 0; });

  const Tissue& tissue = input.tissues[static_cast<std::size_t>(old)];
  const PhiAtVoxels before = phiAtVoxels(*engine.tissueLevelSet(old), input.geometry);
  const auto near = static_cast<float>(kNear * engine.spacing()),
             same = static_cast<float>(kSame * engine.spacing());
  return voxelsWhere(around(after.box, tissue.box), [&](const Eigen::Vector3i& voxel) {
    const float phi = phiAt(after, voxel, near);
    if (std::abs(phi - phiAt(before, voxel, near)) > same) return phi < 0;
    return input.at(tissue.layer, voxel) == tissue.label;
  });
}

}  // namespace sinew::repair
