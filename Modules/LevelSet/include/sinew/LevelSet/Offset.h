#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

namespace sinew {

/// Moves the surface along its normal: phi - distance, on a box grown where needed, as a signed distance.
/// Where parts of the front meet, creases stay sharp and corners that grow become round.
/// @param levelSet  a signed distance in its band, exact within three samples of the surface; the rest is
///                  marched anew, to `distance`
/// @param distance  mm; > 0 grows the shape, < 0 shrinks it (to nothing, where it is thinner)
/// @throws std::invalid_argument when `distance` is not finite, or the box would have more than 2^31 samples.
/// Cost: two marches, one as wide as the offset: O(samples + |distance|), in parallel; the same bits for any
/// number of threads.
DenseLevelSet offset(const DenseLevelSet& levelSet, double distance);

/// Takes away what no ball of this radius fits into: offset by -radius, then by +radius.
/// @throws std::invalid_argument unless radius >= 0.
DenseLevelSet opening(const DenseLevelSet& levelSet, double radius);

/// Fills what no ball of this radius fits into from outside: offset by +radius, then by -radius.
/// @throws std::invalid_argument unless radius >= 0.
DenseLevelSet closing(const DenseLevelSet& levelSet, double radius);

}  // namespace sinew
