#pragma once

#include "sinew/LevelSet/DenseField.h"
#include "sinew/LevelSet/LevelSet.h"

namespace sinew {

struct DenseLevelSet {
  const DenseField& phi;    ///< signed distance, mm; +-band beyond the band; > 0 on the border of the raster
  Eigen::Isometry3d frame;  ///< raster axes to LPS; a proper rotation and a translation
  double voxelSize = 1;     ///< mm
  double band = 3;          ///< mm
};

/// Copies a dense signed distance into an OpenVDB float grid: class level set, linear transform to LPS mm,
/// background +band, inside tiles -band. Values shrink by `offset` on the way (phi - offset, clamped to
/// +-band).
/// @throws std::invalid_argument unless voxelSize and band are positive.
/// Cost: O(samples), leaves in parallel; the same grid for any number of threads.
LevelSet levelSetFromField(const DenseLevelSet& dense, double offset = 0);

}  // namespace sinew
