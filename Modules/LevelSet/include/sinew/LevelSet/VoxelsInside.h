#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/Segmentation/Segmentation.h"

namespace sinew {

/// A level set at the centres of an image's voxels.
struct PhiAtVoxels {
  VoxelBox box;    ///< voxels of the image that may be inside
  DenseField phi;  ///< mm, on the box
};

/// Level set to voxels: tricubic at voxel centres, +band beyond the level set's samples. A voxel belongs to
/// the tissue where phi < 0. Cost: O(voxels of the box), in parallel.
PhiAtVoxels phiAtVoxels(const DenseLevelSet& levelSet, const ImageGeometry& geometry);

}  // namespace sinew
