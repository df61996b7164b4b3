#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/LevelSet/LevelSet.h"
#include "sinew/Segmentation/Segmentation.h"

namespace sinew {

struct LevelSetFromLabelsOptions {
  double smoothingVoxels = 1;  ///< standard deviation of the Gauss, voxels; 0 keeps the voxels' stairs
  double bandVoxels = 4;       ///< half width of the narrow band, level set voxels, >= 3
  /// Largest over smallest spacing from which slices are interpolated by shape; of blocks of voxels where the
  /// grid is coarser than these.
  double thickSliceRatio = 1.8;
  double gridSpacing = 0;  ///< mm; 0: the smallest image spacing, but not below half a voxel (cube root)
  /// Let no piece, tunnel or cavity of the voxels come or go, where the grid is not coarser than these.
  bool preserveTopology = false;
  bool onCommonLattice = false;  ///< samples on commonLattice of the image, so that tissues can be combined
};

/// What the conversion did to the tissue.
struct LevelSetFromLabelsReport {
  double isoValue = 0;             ///< value of the smoothed mask that keeps the label's number of voxels
  bool shapeInterpolated = false;  ///< the slice-wise path was taken
  double labelVolume = 0;          ///< voxels times voxel volume, mm^3
  double levelSetVolume = 0;       ///< volume of phi < 0, mm^3
  std::int64_t heldSamples = 0;    ///< whose side was kept for the sake of the topology
};

/// Spacing of the level set where the options leave it open: the smallest image spacing, but not below half a
/// voxel (cube root of its volume), mm.
double defaultGridSpacing(const ImageGeometry& geometry);

/// Turns the voxels of one tissue into a signed distance: crop with a margin of background, in blocks of
/// voxels where the grid is that much coarser, Gauss with the iso value that keeps the label's volume and
/// with levels of their own for thin parts, or slice-wise 2-D distances and shape interpolation across thick
/// slices, resampling to an isotropic grid, narrow-band fast marching (second order within three samples),
/// and an offset (below half a voxel) that makes the volume right. The grid's axes are the rotation nearest
/// to the image's; one is reversed where the image is left-handed, and the axis across thick slices comes
/// last.
///
/// Pieces of a few voxels that smoothing would wipe out stay as they were drawn; a tissue that would vanish
/// as a whole is smoothed less.
/// @throws std::invalid_argument on options out of range or a tissue without voxels.
/// Cost: O(box of the tissue) plus O(band); memory: one float per sample of the level set's box, and less
/// than half as much again.
DenseLevelSet denseLevelSetFromLabels(const Segmentation& segmentation, const Tissue& tissue,
                                      const LevelSetFromLabelsOptions& options = {},
                                      LevelSetFromLabelsReport* report = nullptr);

/// The same as a grid of OpenVDB. In an object file of its own: a program that stays with the dense level set
/// does not load OpenVDB, which would take it longer than a small mesh.
LevelSet levelSetFromLabels(const Segmentation& segmentation, const Tissue& tissue,
                            const LevelSetFromLabelsOptions& options = {},
                            LevelSetFromLabelsReport* report = nullptr);

}  // namespace sinew
