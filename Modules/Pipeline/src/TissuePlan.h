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
  double motion = 0;  ///< time of the motion by mean curvature that follows, mm^2
};

/// What a tissue is to have.
struct TissueWish {
  double edge = 0;       ///< cube size at the surface, > 0
  bool ownEdge = false;  ///< asked for by name
  Smoothing smoothing = {};
};

TissuePlan planTissue(const Segmentation& segmentation, const Tissue& tissue, const TissueWish& wish,
                      const MeshTissuesOptions& options);

/// The same for one of the edge lengths that a search tries: refinement goes two levels down at most, so that
/// the number of tets follows the edge length.
TissuePlan planTrial(const Segmentation& segmentation, const Tissue& tissue, const TissueWish& wish,
                     const MeshTissuesOptions& options);

}  // namespace sinew
