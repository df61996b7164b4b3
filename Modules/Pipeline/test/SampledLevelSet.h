#pragma once

#include "sinew/LevelSet/LevelSet.h"

#include <functional>

namespace sinew::test {

/// Samples a distance (in voxels of grid index) on a box of indices, with the narrow band and tiles of
/// OpenVDB.
LevelSet sampled(const std::function<double(const Eigen::Vector3d&)>& phi, const Eigen::Vector3i& lower,
                 const Eigen::Vector3i& upper, double voxelSize = 1);

}  // namespace sinew::test
