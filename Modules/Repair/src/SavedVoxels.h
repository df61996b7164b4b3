#pragma once

#include "AssembleLabels.h"
#include "ComputingEngine.h"
#include "Session.h"

namespace sinew::repair {

/// The voxels of a saved shape: those with phi < 0 at their centre. Near the surface, where phi is that of
/// the tissue from which the shape came (or which it replaces), the voxels stay as they were read: a local
/// repair changes voxels near it only, and an untouched tissue none. Cost: O(voxels of the boxes).
VoxelSet savedVoxels(const Segmentation& input, const Saving& saving, ComputingEngine& engine);

}  // namespace sinew::repair
