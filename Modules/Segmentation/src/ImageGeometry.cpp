#include "sinew/Segmentation/ImageGeometry.h"

#include <cmath>

namespace sinew {

Eigen::Affine3d ImageGeometry::indexToPhysical() const {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() = direction * spacing.asDiagonal();
  map.translation() = origin;
  return map;
}

double ImageGeometry::voxelVolume() const { return std::abs(direction.determinant()) * spacing.prod(); }

double ImageGeometry::meanSpacing() const { return std::cbrt(voxelVolume()); }

std::int64_t ImageGeometry::voxelCount() const { return size.cast<std::int64_t>().prod(); }

}  // namespace sinew
