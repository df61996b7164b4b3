#pragma once

#include "TissuePlan.h"
#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/LevelSet/ShapeMeasures.h"

namespace sinew {

/// A tissue's level set as its plan wants it.
struct TissueLevelSet {
  DenseLevelSet levelSet;
  LevelSetFromLabelsReport volumes;  ///< levelSetVolume after all smoothing
  SmoothingReport smoothing;
};

TissueLevelSet makeTissueLevelSet(const Segmentation& segmentation, const Tissue& tissue,
                                  const TissuePlan& plan);

/// What smoothing changed of a tissue's pieces and cavities, and the option to change; empty for nothing.
std::string smoothingWarning(const SmoothingReport& report);

}  // namespace sinew
