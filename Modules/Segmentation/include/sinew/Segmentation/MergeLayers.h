#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

struct MergeLayersOptions {
  /// Who keeps a voxel that several tissues claim: the first of these names or IDs; those that are not listed
  /// come behind, as in the table. Without a list an overlap is refused.
  std::optional<std::vector<std::string>> priority = {};
};

/// A tissue whose label had to change, because another layer uses the same one.
struct LabelChange {
  std::string name;
  int layer = 0;  ///< where it was
  std::int32_t from = 0;
  std::int32_t to = 0;
};

struct MergedLayers {
  Segmentation segmentation;         ///< of one layer
  std::vector<LabelChange> changes;  ///< in the order of the tissues
  std::int64_t contestedVoxels = 0;  ///< that several tissues claimed, and one of them kept
};

/// Puts all layers into one. Tissues keep their labels where they can: the first layer's keep all; a later
/// one that would collide gets the smallest positive label that nobody uses. Unlisted tissues of the first
/// layer come first.
/// @throws std::runtime_error naming the source, two tissues that overlap and the remedy, when there is no
/// priority
///         list; std::invalid_argument for a name of the list that no tissue has.
/// Cost: O(voxels * layers).
MergedLayers mergeLayers(const Segmentation& segmentation, const MergeLayersOptions& options = {});

}  // namespace sinew
