#pragma once

#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/Segmentation/Segmentation.h"

namespace sinew {

/// What meshing one tissue will take, guessed from its voxels alone.
struct TissueCost {
  double work = 0;    ///< arbitrary unit: comparable between tissues
  double memory = 0;  ///< bytes, roughly and rather too much
};

/// @param edgeLength     cube size at the surface, mm
/// @param maxEdgeLength  cube size deep inside, mm
/// Cost: O(box of the tissue).
TissueCost estimateCost(const Segmentation& segmentation, const Tissue& tissue, double edgeLength,
                        double maxEdgeLength, const LevelSetFromLabelsOptions& options);

}  // namespace sinew
