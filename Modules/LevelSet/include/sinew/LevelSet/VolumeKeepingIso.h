#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// The value c for which `count` samples of a smoothed mask lie above it: the iso value that keeps a label's
/// number of voxels, where 0.5 would lose thin and round parts.
/// @param field  values in [0, 1], high inside
/// @param count  how many samples are to lie above, 0 < count < samples; need not be whole
/// @return c in (0, 1), within 1/4096 of the count's quantile
/// @throws std::invalid_argument on a count out of range.
/// Cost: O(samples), one pass.
double volumeKeepingIso(const DenseField& field, double count);

}  // namespace sinew
