#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <cstdint>
#include <vector>

namespace sinew {

/// The connected pieces of one tissue.
struct LabelComponents {
  VoxelBox box;                            ///< box of the tissue; `ids` is its raster, x fastest
  std::vector<std::int32_t> ids;           ///< -1 outside the tissue, else index into voxels
  std::vector<std::int64_t> voxels;        ///< voxel count of each piece, largest first

  /// Piece at a voxel index; -1 outside the tissue or the box.
  std::int32_t at(const Eigen::Vector3i& index) const;
};

/// 26-connected pieces of a tissue. Cost: O(box).
LabelComponents labelComponents(const Segmentation& segmentation, const Tissue& tissue);

}  // namespace sinew
