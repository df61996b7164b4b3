#pragma once

#include "TissueCost.h"
#include "sinew/Pipeline/MeshTissues.h"

namespace sinew {

/// The sizes with which a tissue is meshed, and the level set that goes with them.
struct TissuePlan {
  TissueSizes sizes;
  bool sizeReduced = false;  ///< the wanted edge length was larger than the tissue
  double thinnest = 0;       ///< smallest cube where thin parts would be lost otherwise, mm
  LevelSetFromLabelsOptions levelSet;
};

/// @param edge  cube size wanted at the surface, mm, > 0
TissuePlan planTissue(const Segmentation& segmentation, const Tissue& tissue, double edge,
                      const MeshTissuesOptions& options);

/// The same for one of the edge lengths that a search tries: refinement goes two levels down at most, so that
/// the number of tets follows the edge length.
TissuePlan planTrial(const Segmentation& segmentation, const Tissue& tissue, double edge,
                     const MeshTissuesOptions& options);

}  // namespace sinew
