#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

namespace sinew {

/// Constructive solid geometry on level sets of one lattice (METHOD [16]):
///     union  min(a, b),   intersection  max(a, b),   difference  max(a, -b).
/// With a blend radius r > 0 the crease where both surfaces are nearer than r is rounded by a fillet; ...
/// The result is 1-Lipschitz and has the right zero set, but inside an overlap it is no distance: redistance
/// it before offset, smooth, opening or closing.
/// @param blend  mm, >= 0
/// @throws std::invalid_argument when a and b do not share their lattice, or blend is negative or wider than
/// the band.
/// Cost: O(samples of the box of both), in parallel.
DenseLevelSet unite(const DenseLevelSet& a, const DenseLevelSet& b, double blend = 0);
DenseLevelSet intersect(const DenseLevelSet& a, const DenseLevelSet& b, double blend = 0);
DenseLevelSet subtract(const DenseLevelSet& a, const DenseLevelSet& b, double blend = 0);

}  // namespace sinew
