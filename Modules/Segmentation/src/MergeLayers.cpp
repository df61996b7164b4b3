#include "sinew/Segmentation/MergeLayers.h"

#include "Text.h"
#include "sinew/Segmentation/SelectTissues.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <unordered_map>

namespace sinew {

namespace {

/// What becomes of the voxels of one label of one layer.
struct Claim {
  const Tissue* tissue;
  std::int32_t label;  ///< the new one
  std::size_t rank;    ///< the lowest keeps a contested voxel
};

/// [layer][old label]
using Claims = std::vector<std::unordered_map<std::int32_t, Claim>>;

/// Ranks of the tissues: the listed ones by their place, the others behind.
std::vector<std::size_t> ranks(const Segmentation& segmentation, const std::vector<std::string>& priority) {
  const std::size_t count = segmentation.tissues.size();
  std::vector<std::size_t> result(count);
  for (std::size_t t = 0; t < count; ++t) result[t] = priority.size() + t;
  for (std::size_t place = priority.size(); place-- > 0;)
    for (const int t : selectTissues(segmentation, {priority[place]})) result[t] = place;
  return result;
}

/// Keeps labels while they are free, and else takes the smallest positive one that nobody has.
class DistinctLabels {
 public:
  explicit DistinctLabels(const Segmentation& segmentation) {
    for (const auto* tissues : {&segmentation.tissues, &segmentation.emptyTissues})
      for (const Tissue& tissue : *tissues) known_.insert(tissue.label);
  }

  std::int32_t labelFor(std::int32_t wanted) {
    if (taken_.insert(wanted).second) return wanted;
    while (known_.contains(next_)) ++next_;
    taken_.insert(next_);
    return next_++;
  }

 private:
  std::set<std::int32_t> known_, taken_;
  std::int32_t next_ = 1;
};

Claims claimsOf(const Segmentation& segmentation, const std::vector<std::size_t>& ranks,
                DistinctLabels& labels) {
  Claims claims(segmentation.layers.size());
  for (std::size_t t = 0; t < segmentation.tissues.size(); ++t) {
    const Tissue& tissue = segmentation.tissues[t];
    auto& layer = claims.at(static_cast<std::size_t>(tissue.layer));
    const auto [claim, isNew] = layer.try_emplace(tissue.label, Claim{&tissue, 0, ranks[t]});
    if (isNew) claim->second.label = labels.labelFor(tissue.label);
  }
  return claims;
}

[[noreturn]] void refuseOverlap(const Segmentation& segmentation, const Claim& a, const Claim& b,
                                std::size_t voxel) {
  const auto nx = static_cast<std::size_t>(segmentation.geometry.size.x());
  const auto ny = static_cast<std::size_t>(segmentation.geometry.size.y());
  text::refuse(segmentation.source,
               "`" + text::printable(a.tissue->name) + "` and `" + text::printable(b.tissue->name) +
                   "` overlap, first in voxel (" + std::to_string(voxel % nx) + ", " +
                   std::to_string(voxel / nx % ny) + ", " + std::to_string(voxel / nx / ny) +
                   "), and one layer holds one tissue per voxel; write a .seg.nrrd, which keeps both, or say "
                   "which tissue comes first (--priority)");
}

/// The claims of one layer, asked voxel by voxel: neighbours mostly have the same label.
class ClaimFinder {
 public:
  explicit ClaimFinder(const std::unordered_map<std::int32_t, Claim>& claims) : claims_(claims) {}

  const Claim& operator()(std::int32_t label) {
    if (last_ && label == lastLabel_) return *last_;
    const auto found = claims_.find(label);
    if (found == claims_.end())
      throw std::invalid_argument("mergeLayers: label " + std::to_string(label) +
                                  " is in no table; call updateTissueTable first");
    lastLabel_ = label;
    return *(last_ = &found->second);
  }

 private:
  const std::unordered_map<std::int32_t, Claim>& claims_;
  std::int32_t lastLabel_ = 0;
  const Claim* last_ = nullptr;
};

/// Puts a layer onto what is there.
class Merger {
 public:
  Merger(const Segmentation& segmentation, const Claims& claims, bool mayOverlap)
      : segmentation_(segmentation),
        claims_(claims),
        mayOverlap_(mayOverlap),
        merged_(static_cast<std::size_t>(segmentation.geometry.voxelCount()), 0),
        contested_(merged_.size(), false) {
    for (const auto& layer : claims)
      for (const auto& [label, claim] : layer) owners_.emplace(claim.label, claim);
  }

  void add(std::size_t layer) {
    ClaimFinder claimOf(claims_[layer]), ownerOf(owners_);
    const std::vector<std::int32_t>& voxels = segmentation_.layers[layer];
    for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel) {
      if (voxels[voxel] == 0) continue;
      const Claim& claim = claimOf(voxels[voxel]);
      if (merged_[voxel] == 0) {
        merged_[voxel] = claim.label;
        continue;
      }
      const Claim& owner = ownerOf(merged_[voxel]);
      if (!mayOverlap_) refuseOverlap(segmentation_, owner, claim, voxel);
      contested_[voxel] = true;
      if (claim.rank < owner.rank) merged_[voxel] = claim.label;
    }
  }

  std::int64_t contestedVoxels() const { return std::ranges::count(contested_, true); }
  std::vector<std::int32_t> take() { return std::move(merged_); }

 private:
  const Segmentation& segmentation_;
  const Claims& claims_;
  bool mayOverlap_;
  std::vector<std::int32_t> merged_;
  std::vector<bool> contested_;
  std::unordered_map<std::int32_t, Claim> owners_;  ///< by new label
};

/// A tissue as it stands on the one layer.
Tissue moved(const Tissue& tissue, std::int32_t label, std::vector<LabelChange>& changes) {
  if (label != tissue.label) changes.push_back({tissue.name, tissue.layer, tissue.label, label});
  Tissue result = tissue;
  result.layer = 0;
  result.label = label;
  return result;
}

}  // namespace

MergedLayers mergeLayers(const Segmentation& segmentation, const MergeLayersOptions& options) {
  DistinctLabels labels(segmentation);
  const Claims claims = claimsOf(
      segmentation, ranks(segmentation, options.priority.value_or(std::vector<std::string>{})), labels);
  Merger merger(segmentation, claims, options.priority.has_value());
  for (std::size_t layer = 0; layer < segmentation.layers.size(); ++layer) merger.add(layer);

  MergedLayers result{.segmentation = {.geometry = segmentation.geometry,
                                       .layers = {},
                                       .tissues = {},
                                       .emptyTissues = {},
                                       .source = segmentation.source,
                                       .keys = segmentation.keys,
                                       .warnings = segmentation.warnings},
                      .changes = {},
                      .contestedVoxels = merger.contestedVoxels()};
  result.segmentation.layers.push_back(merger.take());
  for (const Tissue& tissue : segmentation.tissues)
    result.segmentation.tissues.push_back(
        moved(tissue, claims[tissue.layer].at(tissue.label).label, result.changes));
  for (const Tissue& tissue : segmentation.emptyTissues)
    result.segmentation.tissues.push_back(moved(tissue, labels.labelFor(tissue.label), result.changes));
  updateTissueTable(result.segmentation);
  return result;
}

}  // namespace sinew
