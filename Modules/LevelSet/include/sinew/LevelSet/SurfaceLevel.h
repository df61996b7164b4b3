#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

struct SurfaceLevelOptions {
  double windowVoxels = 2;  ///< standard deviation of the window that the level is averaged over, voxels
  double tolerated =
      0.05;            ///< deviation of the level from the iso value that is left alone (noise, curvature)
  double full = 0.15;  ///< deviation from which the local level alone counts
};

/// Turns a smoothed mask u into a field that is negative inside: level - u.
///
/// One iso value for the whole tissue loses its thin parts: a plate of one voxel peaks at u = 0.38, a tube at
/// 0.15. The local level is what u has at the faces between tissue and background (half way between the two
/// voxels, cubic), averaged over a Gauss window on the surface; the digital surface keeps its place on
/// average, so that thin plates and tubes keep their thickness and narrow gaps stay open. Where the local
/// level is near `iso`, `iso` is used.
/// @param field  the smoothed mask, replaced by the result
/// @param sigmaVoxels  with which it was smoothed; axes with 0 have no faces (slice by slice)
/// @param iso  level of the thick parts, see volumeKeepingIso
/// @throws std::invalid_argument when mask and field differ in size.
/// Cost: O(voxels), in parallel; an eighth of the field as extra memory; same bits for any number of threads.
void subtractSurfaceLevel(DenseField& field, const DenseMask& mask, const Eigen::Vector3d& sigmaVoxels,
                          double iso, const SurfaceLevelOptions& options = {});

}  // namespace sinew
