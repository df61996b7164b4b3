#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// Keeps the samples nearer than `near`, which know their distance, and marches from them to the band.
/// @param near  mm, more than the spacing: every sample beside the surface knows its distance
/// Cost: O(samples + band), tiles in parallel; the same bits for any number of threads.
void marchOn(DenseField& phi, double spacing, double near, double band);

}  // namespace sinew
