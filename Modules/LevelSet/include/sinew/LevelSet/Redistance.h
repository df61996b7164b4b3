#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

namespace sinew {

/// Makes phi a signed distance again, by fast marching from its zero set (see fastMarching; two layers of
/// closest points, so that the surface stays where it is however often this is done): after CSG, or
/// after anything else that bent it. No sample changes side. Cost: O(samples + band), in parallel.
void redistance(DenseLevelSet& levelSet);

}  // namespace sinew
