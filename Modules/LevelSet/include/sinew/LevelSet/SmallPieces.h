#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// Puts back the small pieces of a mask (26-connected) that smoothing has wiped out: where no voxel of a
/// piece is inside the field, all of them get the value `inside`, that is, they stay as they were drawn.
/// @param field  negative inside, same size as the mask
/// @param inside  < 0
/// @param mostVoxels  larger pieces are left alone
/// @return how many pieces were put back
/// @throws std::invalid_argument when the sizes differ or inside is not negative.
/// Cost: O(voxels) where nothing is lost.
int restoreSmallPieces(DenseField& field, const DenseMask& mask, float inside, int mostVoxels = 100);

}  // namespace sinew
