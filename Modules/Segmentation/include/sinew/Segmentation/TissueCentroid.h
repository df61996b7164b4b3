#pragma once

#include "sinew/Segmentation/Segmentation.h"

namespace sinew {

/// Mean of a tissue's voxel centres, LPS mm. Cost: O(its box).
/// @param tissue  one of `segmentation.tissues`
Eigen::Vector3d tissueCentroid(const Segmentation& segmentation, const Tissue& tissue);

/// Axis-aligned box in LPS mm that holds all of a tissue's voxels, corners too: lower and upper corner.
std::array<Eigen::Vector3d, 2> tissueBounds(const ImageGeometry& geometry, const Tissue& tissue);

}  // namespace sinew
