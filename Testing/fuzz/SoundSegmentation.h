#pragma once

#include "sinew/Segmentation/Segmentation.h"

namespace sinew::fuzz {

/// Every layer has all voxels, every tissue of the table has some, inside the volume.
/// @throws std::logic_error that names what does not hold
void requireSound(const Segmentation& segmentation);

}  // namespace sinew::fuzz
