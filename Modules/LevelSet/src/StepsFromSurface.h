#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// How many steps along the axes a sample is from the nearest sample on the other side; atMost + 1 where it
/// is more than atMost, which is below 255. Cost: O(samples), in parallel.
DenseMask stepsFromSurface(const DenseField& phi, int atMost);

}  // namespace sinew
