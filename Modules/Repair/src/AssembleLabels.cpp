#include "AssembleLabels.h"

#include <algorithm>
#include <map>

namespace sinew::repair {
namespace {

using Labels = std::vector<std::int32_t>;

/// Calls visit(n) with the position in a layer of every voxel of a set.
template <class Visit>
void forEachVoxel(const VoxelSet& voxels, const Eigen::Vector3i& imageSize, const Visit& visit) {
  const Eigen::Vector3i& lower = voxels.box.lower;
  for (int k = 0; k < voxels.inside.size.z(); ++k)
    for (int j = 0; j < voxels.inside.size.y(); ++j) {
      const std::uint8_t* row = voxels.inside.row(j, k);
      const std::size_t first =
          lower.x() + static_cast<std::size_t>(imageSize.x()) *
                          (lower.y() + j + static_cast<std::size_t>(imageSize.y()) * (lower.z() + k));
      for (int i = 0; i < voxels.inside.size.x(); ++i)
        if (row[i] != 0) visit(first + static_cast<std::size_t>(i));
    }
}

/// The segmentation in the making.
class Assembly {
 public:
  Assembly(const Segmentation& input, const LabelWishes& wishes)
      : input_(input), wishes_(wishes), result_{.segmentation = input, .claims = {}, .losses = {}} {
    enterClaims();
    clearVoxels();
  }

  AssembledLabels assembled() {
    if (wishes_.layers)
      placeOnLayers();
    else
      paintByRank();
    countVoxels();
    finishTable();
    return std::move(result_);
  }

 private:
  Labels& layer(int n) { return result_.segmentation.layers[static_cast<std::size_t>(n)]; }
  template <class Visit>
  void visit(const VoxelSet& voxels, const Visit& visitor) {
    forEachVoxel(voxels, input_.geometry.size, visitor);
  }

  // The table.

  void enterClaims() {
    for (const Claim& claim : wishes_.claims) {
      Tissue tissue =
          claim.tissue >= 0 ? input_.tissues[static_cast<std::size_t>(claim.tissue)] : newTissue(claim.name);
      if (claim.color) tissue.color = *claim.color;
      result_.claims.push_back({tissue.layer, tissue.label, tissue.voxels, 0, {}});
      entries_.push_back(std::move(tissue));
    }
  }

  Tissue newTissue(const std::string& name) {
    std::vector<Tissue>& empty = result_.segmentation.emptyTissues;
    const auto found = std::ranges::find_if(
        empty, [&](const Tissue& tissue) { return tissue.name == name || tissue.id == name; });
    if (found != empty.end()) {
      Tissue tissue = *found;
      empty.erase(found);
      if (tissue.layer < 0 || tissue.layer >= std::ssize(input_.layers)) tissue.layer = 0;
      if (!isUsed(tissue.layer, tissue.label)) return tissue;
    }
    Tissue tissue;
    tissue.name = tissue.id = name;
    tissue.label = freeLabel();
    tissue.color = labelColor(tissue.label);
    tissue.named = true;
    const auto sameId = [&](const Tissue& other) { return other.id == tissue.id; };
    while (anyEntry(sameId)) tissue.id.append("_").append(std::to_string(tissue.label));
    return tissue;
  }

  /// Whether a condition holds for a tissue of the input or a claim.
  template <class Condition>
  bool anyEntry(const Condition& condition) const {
    return std::ranges::any_of(input_.tissues, condition) ||
           std::ranges::any_of(input_.emptyTissues, condition) || std::ranges::any_of(entries_, condition);
  }

  bool isUsed(int layer, std::int32_t label) const {
    return label == 0 || anyEntry([&](const Tissue& other) {
             return other.layer == layer && other.label == label && other.voxels > 0;
           });
  }

  std::int32_t freeLabel() const {
    std::set<std::int32_t> used;
    for (const auto* table : {&input_.tissues, &input_.emptyTissues, &entries_})
      for (const Tissue& tissue : *table) used.insert(tissue.label);
    std::int32_t label = 1;
    while (used.contains(label)) ++label;
    return label;
  }

  bool isClaimed(int tissue) const {
    return std::ranges::any_of(wishes_.claims, [&](const Claim& claim) { return claim.tissue == tissue; });
  }

  void finishTable() {
    std::vector<Tissue> table;
    for (std::size_t t = 0; t < input_.tissues.size(); ++t)
      if (!wishes_.removed.contains(static_cast<int>(t)) && !isClaimed(static_cast<int>(t)))
        table.push_back(input_.tissues[t]);
    table.insert(table.end(), entries_.begin(), entries_.end());
    result_.segmentation.tissues = std::move(table);
    updateTissueTable(result_.segmentation);
  }

  // The voxels.

  /// Takes away what claimed and removed tissues had.
  void clearVoxels() {
    for (std::size_t t = 0; t < input_.tissues.size(); ++t) {
      const Tissue& tissue = input_.tissues[t];
      if (!wishes_.removed.contains(static_cast<int>(t)) && !isClaimed(static_cast<int>(t))) continue;
      Labels& labels = layer(tissue.layer);
      visit(voxelsOf(input_, tissue), [&](std::size_t n) { labels[n] = 0; });
    }
  }

  bool hasPriority(const std::string& name) const {
    return std::ranges::find(wishes_.priority, name) != wishes_.priority.end();
  }

  /// From the lowest rank to the highest one, each over what is there.
  void paintByRank() {
    for (std::size_t c = 0; c < entries_.size(); ++c)
      if (!hasPriority(entries_[c].name)) paintWhereFree(c);
    for (auto name = wishes_.priority.rbegin(); name != wishes_.priority.rend(); ++name) {
      for (std::size_t c = 0; c < entries_.size(); ++c)
        if (entries_[c].name == *name) paint(wishes_.claims[c].voxels, entries_[c]);
      for (std::size_t t = 0; t < input_.tissues.size(); ++t)
        if (input_.tissues[t].name == *name && !isClaimed(static_cast<int>(t)) &&
            !wishes_.removed.contains(static_cast<int>(t)))
          paint(voxelsOf(input_, input_.tissues[t]), input_.tissues[t]);
    }
  }

  void paint(const VoxelSet& voxels, const Tissue& tissue) {
    Labels& labels = layer(tissue.layer);
    visit(voxels, [&](std::size_t n) { labels[n] = tissue.label; });
  }

  /// Over background and older claims, but not over tissues without a claim.
  void paintWhereFree(std::size_t claim) {
    const Tissue& tissue = entries_[claim];
    std::set<std::int32_t> older;
    for (std::size_t c = 0; c < claim; ++c)
      if (entries_[c].layer == tissue.layer) older.insert(entries_[c].label);
    Labels& labels = layer(tissue.layer);
    visit(wishes_.claims[claim].voxels, [&](std::size_t n) {
      if (labels[n] == 0 || older.contains(labels[n])) labels[n] = tissue.label;
    });
  }

  void placeOnLayers() {
    for (std::size_t c = 0; c < entries_.size(); ++c) {
      Tissue& tissue = entries_[c];
      const int home = tissue.layer;
      int place = home;
      if (!isFree(wishes_.claims[c].voxels, home)) {
        place = 0;
        while (place < layerCount() && !isFree(wishes_.claims[c].voxels, place)) ++place;
      }
      if (place == layerCount()) result_.segmentation.layers.emplace_back(layer(0).size(), 0);
      if (place != home && isUsed(place, tissue.label)) tissue.label = freeLabel();
      tissue.layer = place;
      result_.claims[c].layer = place;
      result_.claims[c].label = tissue.label;
      paint(wishes_.claims[c].voxels, tissue);
    }
  }

  int layerCount() const { return static_cast<int>(result_.segmentation.layers.size()); }

  bool isFree(const VoxelSet& voxels, int place) {
    const Labels& labels = layer(place);
    bool free = true;
    visit(voxels, [&](std::size_t n) { free = free && labels[n] == 0; });
    return free;
  }

  // The count.

  void countVoxels() {
    for (std::size_t c = 0; c < entries_.size(); ++c) {
      ClaimResult& claim = result_.claims[c];
      std::map<std::int32_t, std::int64_t> owners;
      const Labels& labels = layer(entries_[c].layer);
      visit(wishes_.claims[c].voxels, [&](std::size_t n) { ++owners[labels[n]]; });
      claim.voxelsAfter = owners[entries_[c].label];
      owners.erase(entries_[c].label);
      for (const auto& [label, voxels] : owners)
        claim.yielded.emplace_back(nameOn(claim.layer, label), voxels);
    }
    if (!wishes_.priority.empty() && !wishes_.layers) countLosses();
  }

  void countLosses() {
    for (std::size_t t = 0; t < input_.tissues.size(); ++t) {
      const Tissue& tissue = input_.tissues[t];
      if (isClaimed(static_cast<int>(t)) || wishes_.removed.contains(static_cast<int>(t))) continue;
      std::map<std::int32_t, std::int64_t> owners;
      const Labels& labels = layer(tissue.layer);
      visit(voxelsOf(input_, tissue), [&](std::size_t n) { ++owners[labels[n]]; });
      owners.erase(tissue.label);
      for (const auto& [label, voxels] : owners)
        result_.losses.push_back({tissue.name, nameOn(tissue.layer, label), voxels});
    }
  }

  std::string nameOn(int layer, std::int32_t label) const {
    for (const auto* table : {&entries_, &input_.tissues})
      for (const Tissue& tissue : *table)
        if (tissue.layer == layer && tissue.label == label) return tissue.name;
    return "label " + std::to_string(label);
  }

  const Segmentation& input_;
  const LabelWishes& wishes_;
  std::vector<Tissue> entries_;  ///< of the claims, in their order
  AssembledLabels result_;
};

}  // namespace

VoxelSet voxelsOf(const Segmentation& segmentation, const Tissue& tissue) {
  VoxelSet voxels{tissue.box, {}};
  if (tissue.box.empty()) return voxels;
  voxels.inside = DenseMask(tissue.box.upper - tissue.box.lower);
  const Eigen::Vector3i& size = voxels.inside.size;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        voxels.inside(i, j, k) =
            segmentation.at(tissue.layer, tissue.box.lower + Eigen::Vector3i(i, j, k)) == tissue.label;
  return voxels;
}

AssembledLabels assembleLabels(const Segmentation& input, const LabelWishes& wishes) {
  return Assembly(input, wishes).assembled();
}

}  // namespace sinew::repair
