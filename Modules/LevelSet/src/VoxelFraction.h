#pragma once

#include "sinew/LevelSet/FieldVolume.h"

#include <array>

namespace sinew {

/// A voxel is cut when its mean lies within half of its diagonal; the mean differs a little from its phi.
inline constexpr double kCutReach = 0.6;

/// phi at a voxel and at its six neighbours: before and after along each axis.
struct PhiStencil {
  double centre;
  std::array<double, 3> before, after;
};

/// Part of the voxel with phi < level; see fieldVolume.
double voxelFraction(const PhiStencil& phi, const Eigen::Vector3d& spacing, double level);

}  // namespace sinew
