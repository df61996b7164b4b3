#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// fastMarching for a band that is wide: within three samples of the surface it is fastMarching; from there
/// every second sample along each axis is marched on, and the samples between take the mean of those around
/// them. There phi only says how far away the surface is: to 1.5 % on average, 15 % at worst, and more at
/// kinks.
/// @param phi  negative inside; zero counts as outside. No sample changes side. Replaced by the signed
///             distance, +-band beyond the band.
/// @param spacing  along each axis, mm; need not be equal
/// @param band  half width, mm
/// @throws std::invalid_argument unless spacing > 0 and band > 0.
/// Cost: O(samples + band), tiles in parallel; the same bits for any number of threads. Half of
/// fastMarching's for a band of eight samples.
void bandDistance(DenseField& phi, const Eigen::Vector3d& spacing, double band);

}  // namespace sinew
