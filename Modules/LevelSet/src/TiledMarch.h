#pragma once

#include "BandMarch.h"
#include "SurfaceSeeds.h"

namespace sinew {

/// Marches a raster of any size outward from its seeds, both sides of the surface at once and each by itself,
/// in tiles with a halo as wide as the band.
/// @param phi  its signs are read; replaced by the distances, +-band beyond the band
/// @param seeds  samples of known distance, slice by slice in raster order
/// Cost: O(samples + band), tiles in parallel; the same bits for any number of threads.
void tiledMarch(DenseField& phi, const std::vector<std::vector<SurfaceSeed>>& seeds,
                const Eigen::Vector3d& spacing, double band, const BandMarchOptions& options = {});

}  // namespace sinew
