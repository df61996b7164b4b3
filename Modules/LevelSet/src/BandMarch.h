#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <limits>

namespace sinew {

/// What a sample holds that the march has not reached, with the sign of its side.
inline constexpr float kUnreached = std::numeric_limits<float>::max();
/// What lies around the raster; neither side.
inline constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
/// Layers of kNowhere that bandMarch needs on every side: the reach of a second-order difference.
inline constexpr int kBorder = 2;

struct BandMarchOptions {
  int order = 2;          ///< of the upwind differences, 1 or 2
  bool fixBeside = true;  ///< seeds that have a neighbour on the other side keep their distance
  double keepWithin = 0;  ///< the others keep theirs unless there is a way that is shorter by this much, mm
};

/// Marches outward from the seeds of a small raster, on both sides of the surface at once: no sample looks
/// across.
/// @param phi  the seeds' signed distances, +-kUnreached elsewhere, kBorder layers of kNowhere around all;
/// replaced by
///             the distances within the band
/// @param seeds  indices of the seeds, fewer than 2^32 samples
void bandMarch(DenseField& phi, const std::vector<std::uint32_t>& seeds, const Eigen::Vector3d& spacing,
               double band, const BandMarchOptions& options = {});

}  // namespace sinew
