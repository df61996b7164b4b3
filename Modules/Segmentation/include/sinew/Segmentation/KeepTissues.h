#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <vector>

namespace sinew {

/// Takes away all tissues but these: their voxels become background, their entries go, empty ones too. Layers
/// stay, also those without a tissue.
/// @param tissues  indices into `segmentation.tissues`, ascending
/// Cost: O(voxels).
void keepTissues(Segmentation& segmentation, const std::vector<int>& tissues);

}  // namespace sinew
