#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <string>
#include <vector>

namespace sinew {

/// The tissues that a person asks for, as ascending indices into `segmentation.tissues`: each wish is a name,
/// a Slicer segment id, a label value (on any layer), or a name up to case and `_` for space, tried in this
/// order. No wishes: all tissues.
/// @throws std::invalid_argument naming the file, the wish, and the nearest names when nothing fits.
std::vector<int> selectTissues(const Segmentation& segmentation, const std::vector<std::string>& wishes);

}  // namespace sinew
