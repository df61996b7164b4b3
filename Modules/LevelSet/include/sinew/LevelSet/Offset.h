#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

namespace sinew {

/// Moves the surface along its normal: phi - distance, on a box grown where needed, as a signed distance.
/// @param levelSet  a signed distance in its band
/// @param distance  mm; > 0 grows the shape, < 0 shrinks it (to nothing, where it is thinner)
/// Cost: O(samples + |distance|): a march as wide as the offset.
DenseLevelSet offset(const DenseLevelSet& levelSet, double distance);

/// Takes away what no ball of this radius fits into: offset by -radius, then by +radius.
DenseLevelSet opening(const DenseLevelSet& levelSet, double radius);

/// Fills what no ball of this radius fits into from outside: offset by +radius, then by -radius.
DenseLevelSet closing(const DenseLevelSet& levelSet, double radius);

}  // namespace sinew
