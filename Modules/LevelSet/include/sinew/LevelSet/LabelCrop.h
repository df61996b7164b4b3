#pragma once

#include "sinew/LevelSet/DenseField.h"
#include "sinew/Segmentation/Segmentation.h"

#include <Eigen/Geometry>

namespace sinew {

/// The voxels of one tissue, cut out of the image with a margin of background.
struct LabelCrop {
  DenseField coverage;              ///< part of each cell that is tissue: 1, 0 or, in blocks, between
  Eigen::Vector3i block;            ///< voxels per cell, along the raster's axes
  Eigen::Vector3d spacing;          ///< of the cells, along the raster's axes, mm
  Eigen::Affine3d indexToPhysical;  ///< raster index to LPS mm; always right-handed
};

/// How the axes of a crop's raster run through the image.
struct RasterAxes {
  Eigen::Vector3i order;       ///< image axis of each raster axis: the last one given, the others in their order
  Eigen::Matrix3d directions;  ///< columns: unit vectors of the raster axes, LPS; right-handed
  bool lastReversed = false;   ///< the last axis runs against the image's
};
RasterAxes rasterAxes(const ImageGeometry& geometry, int lastAxis);

/// Cuts a tissue out. The image axis `lastAxis` becomes the raster's last one, the other two keep their
/// order; where that makes a left-handed raster, the last axis is read backwards. Beyond the image there is
/// background.
/// @param margin  cells of background on every side, along the axes of the image
/// @param block  voxels per cell along the axes of the image; the last cells may reach beyond the tissue's
/// box
/// @throws std::invalid_argument when the tissue has no voxel, its layer does not exist or its box leaves the
/// image. Cost: O(box).
LabelCrop cropLabel(const Segmentation& segmentation, const Tissue& tissue, const Eigen::Vector3i& margin,
                    int lastAxis = 2, const Eigen::Vector3i& block = Eigen::Vector3i::Ones());

/// The cells that are tissue for at least one half: 1, elsewhere 0.
DenseMask mostlyCovered(const DenseField& coverage);

}  // namespace sinew
