#pragma once

#include "sinew/LevelSet/DenseField.h"
#include "sinew/Segmentation/Segmentation.h"

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sinew::repair {

/// Voxels of an image.
struct VoxelSet {
  VoxelBox box;
  DenseMask inside;  ///< on the box
};

/// The voxels of one tissue of a segmentation.
VoxelSet voxelsOf(const Segmentation& segmentation, const Tissue& tissue);

/// A tissue that is to have these voxels.
struct Claim {
  std::string name;
  int tissue = -1;  ///< index in the input; -1: a new one
  std::optional<std::array<double, 3>> color;
  VoxelSet voxels;
};

struct LabelWishes {
  std::vector<Claim> claims = {};          ///< oldest first; names and tissues differ
  std::set<int> removed = {};              ///< indices in the input, not among the claims
  std::vector<std::string> priority = {};  ///< names, first wins
  bool layers = false;                     ///< keep overlaps, on further layers
};

/// What became of a claim.
struct ClaimResult {
  int layer = 0;
  std::int32_t label = 0;
  std::int64_t voxelsBefore = 0, voxelsAfter = 0;
  std::vector<std::pair<std::string, std::int64_t>> yielded;  ///< voxels that went to another tissue
};

struct AssembledLabels {
  Segmentation segmentation;
  std::vector<ClaimResult> claims;
  /// Voxels that tissues without a claim had to give: loser, winner, number.
  struct Loss {
    std::string loser, winner;
    std::int64_t voxels = 0;
  };
  std::vector<Loss> losses;
};

/// Puts claims into a segmentation. Tissues that are neither claimed nor removed pass on as they are.
///
/// Where claims and tissues of one layer overlap, the first one in `priority` has the voxel, then tissues
/// without a claim, then the latest claim. With `layers` all keep what they claim: a claim that would overlap
/// moves to the first layer, old or new, that has room.
///
/// A new tissue takes the entry of a tissue of its name without voxels; else the smallest label that is free
/// on all layers, and a colour of its own.
/// Cost: O(voxels) per layer, and O(boxes of the claims).
AssembledLabels assembleLabels(const Segmentation& input, const LabelWishes& wishes);

}  // namespace sinew::repair
