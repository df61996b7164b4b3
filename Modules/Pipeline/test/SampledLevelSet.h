#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

#include <functional>

namespace sinew::test {

/// Samples a distance, in voxels at an index, on a box of indices; the frame leads back to these indices.
DenseLevelSet sampled(const std::function<double(const Eigen::Vector3d&)>& phi, const Eigen::Vector3i& lower,
                      const Eigen::Vector3i& upper, double voxelSize = 1);

}  // namespace sinew::test
