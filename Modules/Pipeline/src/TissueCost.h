#pragma once

#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/Segmentation/Segmentation.h"

namespace sinew {

struct TissueSizes {
  double edge = 0;      ///< cube size at the surface, mm
  double largest = 0;   ///< deep inside, mm
  double smallest = 0;  ///< that refinement may make, mm
};

/// What meshing one tissue will take, guessed from its voxels alone.
struct TissueCost {
  double work = 0;      ///< arbitrary unit: comparable between tissues
  double memory = 0;    ///< bytes, roughly and rather too much
  double ofVoxels = 0;  ///< the part of `memory` for voxels and level set; it grows with the edge length
};

/// Area of the smooth surface behind the tissue's voxels, mm^2, roughly. Cost: O(box of the tissue).
double surfaceArea(const Segmentation& segmentation, const Tissue& tissue);

/// @param levelSet  with the grid spacing that will be taken
/// Cost: O(box of the tissue).
TissueCost estimateCost(const Segmentation& segmentation, const Tissue& tissue, const TissueSizes& sizes,
                        const LevelSetFromLabelsOptions& levelSet);

}  // namespace sinew
