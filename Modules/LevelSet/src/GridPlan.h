#pragma once

#include "sinew/LevelSet/LabelCrop.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <optional>

namespace sinew {

/// What geometry and options decide about a level set before a voxel is read.
struct GridPlan {
  double h = 1;                                      ///< spacing of the level set, mm
  Eigen::Vector3i block = Eigen::Vector3i::Ones();   ///< voxels per cell, along the axes of the image
  bool thick = false;                                ///< interpolate slices by shape
  int lastAxis = 2;                                  ///< image axis across the slices
  Eigen::Vector3i margin = Eigen::Vector3i::Zero();  ///< cells, along the axes of the image
  double clear = 0;                                  ///< the narrowest margin, mm
  double largestOffset = 0;                          ///< that may correct the volume, mm
  double reach = 0;                                  ///< half width of the march, mm
  std::optional<SampleLattice> lattice;              ///< on which the samples are to lie
};

GridPlan planGrid(const ImageGeometry& geometry, const LevelSetFromLabelsOptions& options);

/// Standard deviation along an axis, cells: a level set coarser than the voxels is smoothed to its own
/// spacing. Blocks of n voxels have already smoothed by the variance (n^2 - 1)/12 of n points in a row.
double sigmaAlong(double smoothingVoxels, double cell, int block, double h);

/// Where the samples of the level set's grid lie, and how they are taken from the crop's raster.
struct GridPlacement {
  Eigen::Isometry3d frame;
  Eigen::Vector3i size;
  Eigen::Vector3d first;  ///< of the aligned grid's first sample, mm from the raster's first
  bool aligned = false;   ///< grid axes are raster axes
};

/// The grid holds the raster and, around the tissue, at least the reach of the march.
GridPlacement placeGrid(const LabelCrop& crop, const GridPlan& plan);

}  // namespace sinew
