#pragma once

#include "sinew/LevelSet/DenseField.h"
#include "sinew/Segmentation/Segmentation.h"

#include <Eigen/Geometry>

namespace sinew {

/// The voxels of one tissue, cut out of the image with a margin of background.
struct LabelCrop {
  DenseMask mask;                   ///< 1 in the tissue, 0 elsewhere
  Eigen::Vector3d spacing;          ///< along the raster's axes, mm
  Eigen::Affine3d indexToPhysical;  ///< raster index to LPS mm; always right-handed
};

/// Cuts a tissue out. The image axis `lastAxis` becomes the raster's last one, the other two keep their
/// order; where that makes a left-handed raster, the last axis is read backwards. Beyond the image there is
/// background.
/// @param margin  background voxels on every side, along the axes of the image
/// @throws std::invalid_argument when the tissue has no voxel, its layer does not exist or its box leaves the
/// image. Cost: O(box).
LabelCrop cropLabel(const Segmentation& segmentation, const Tissue& tissue, const Eigen::Vector3i& margin,
                    int lastAxis = 2);

}  // namespace sinew
