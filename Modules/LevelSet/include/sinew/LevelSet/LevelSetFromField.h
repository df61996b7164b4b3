#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/LevelSet/LevelSet.h"

namespace sinew {

/// Copies a dense signed distance into an OpenVDB float grid: class level set, linear transform to LPS mm,
/// background +band, inside tiles -band. Values shrink by `offset` on the way (phi - offset, clamped to
/// +-band).
/// @throws std::invalid_argument unless voxelSize and band are positive.
/// Cost: O(samples), leaves in parallel; the same grid for any number of threads.
LevelSet levelSetFromField(const DenseLevelSet& dense, double offset = 0);

/// The way back: the grid's values from LevelSet::lower to LevelSet::upper, sample 0 at `lower`.
/// Cost: O(samples), in parallel.
DenseLevelSet fieldFromLevelSet(const LevelSet& levelSet);

}  // namespace sinew
