#include "sinew/Segmentation/Segmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace sinew {

namespace {

/// Voxels and box of one label value on one layer.
struct LabelExtent {
  std::int64_t voxels = 0;
  Eigen::Vector3i lower = Eigen::Vector3i::Constant(std::numeric_limits<int>::max());
  Eigen::Vector3i upper = Eigen::Vector3i::Constant(std::numeric_limits<int>::min());

  /// Adds the voxels i0 <= i < i1 of the row (j, k).
  void addRun(int i0, int i1, int j, int k) {
    voxels += i1 - i0;
    lower = lower.cwiseMin(Eigen::Vector3i(i0, j, k));
    upper = upper.cwiseMax(Eigen::Vector3i(i1, j + 1, k + 1));
  }
};

using LabelExtents = std::unordered_map<std::int32_t, LabelExtent>;

/// A map from label to extent that answers small labels from an array: noise can make every voxel a run.
class ExtentTable {
 public:
  LabelExtent& operator[](std::int32_t label) {
    if (label < 0 || label >= kDense) return extents_[label];
    if (dense_.size() <= static_cast<std::size_t>(label)) dense_.resize(label + 1, nullptr);
    LabelExtent*& slot = dense_[label];
    if (!slot) slot = &extents_[label];  // elements of an unordered_map keep their address
    return *slot;
  }
  LabelExtents take() { return std::move(extents_); }

 private:
  static constexpr std::int32_t kDense = 1 << 16;
  std::vector<LabelExtent*> dense_;
  LabelExtents extents_;
};

/// The first voxel behind i whose label differs, in blocks that the compiler can compare at once.
int endOfRun(const std::int32_t* row, int i, int end) {
  constexpr int kBlock = 32;
  const std::int32_t label = row[i];
  for (; i + kBlock <= end; i += kBlock) {
    std::int32_t different = 0;
    for (int b = 0; b < kBlock; ++b) different |= row[i + b] ^ label;
    if (different != 0) break;
  }
  while (i < end && row[i] == label) ++i;
  return i;
}

LabelExtents labelExtents(const std::vector<std::int32_t>& layer, const Eigen::Vector3i& size) {
  ExtentTable table;
  const std::int32_t* row = layer.data();
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j, row += size.x())
      for (int i = 0; i < size.x();) {
        const std::int32_t label = row[i];
        const int first = i;
        i = endOfRun(row, i, size.x());
        if (label != 0) table[label].addRun(first, i, j, k);
      }
  return table.take();
}

Tissue unnamedTissue(int layer, std::int32_t label) {
  Tissue tissue;
  tissue.name = "Segment_" + std::to_string(label);
  if (layer > 0) tissue.name += "_layer_" + std::to_string(layer);
  tissue.id = tissue.name;
  tissue.layer = layer;
  tissue.label = label;
  tissue.color = labelColor(label);
  return tissue;
}

auto byLayerThenLabel(const Tissue& tissue) { return std::tuple(tissue.layer, tissue.label); }

}  // namespace

std::int32_t Segmentation::at(int layer, const Eigen::Vector3i& index) const {
  const std::int64_t row = index.y() + std::int64_t{geometry.size.y()} * index.z();
  return layers[layer][index.x() + geometry.size.x() * row];
}

std::array<double, 3> labelColor(std::int32_t label) {
  // Hues a golden ratio of the circle apart never come close for neighbouring labels.
  constexpr double goldenRatio = 0.6180339887498949, saturation = 0.55, value = 0.9;
  const double turns = label * goldenRatio;
  const double hue = turns - std::floor(turns);
  std::array<double, 3> color;
  for (int c = 0; c < 3; ++c) {
    // HSV to RGB: a trapezoid over the hue circle, one third apart for red, green and blue.
    const double h = 6 * hue + std::array{0.0, 4.0, 2.0}[c];
    const double m = h - 6 * std::floor(h / 6);
    const double ramp = std::clamp(std::abs(m - 3) - 1, 0.0, 1.0);
    color[c] = value * (1 - saturation * (1 - ramp));
  }
  return color;
}

void updateTissueTable(Segmentation& segmentation) {
  std::vector<LabelExtents> extents;
  for (const auto& layer : segmentation.layers)
    extents.push_back(labelExtents(layer, segmentation.geometry.size));

  std::vector<Tissue> table = std::move(segmentation.tissues);
  std::ranges::move(segmentation.emptyTissues, std::back_inserter(table));
  segmentation.tissues.clear();
  segmentation.emptyTissues.clear();

  std::vector<LabelExtents> unclaimed = extents;
  for (Tissue& tissue : table) {
    tissue.voxels = 0;
    tissue.box = {};
    const bool hasLayer = tissue.layer >= 0 && tissue.layer < static_cast<int>(extents.size());
    const auto found = hasLayer ? extents[tissue.layer].find(tissue.label) : LabelExtents::iterator{};
    if (!hasLayer || found == extents[tissue.layer].end()) {
      segmentation.emptyTissues.push_back(std::move(tissue));
      continue;
    }
    unclaimed[tissue.layer].erase(tissue.label);
    tissue.voxels = found->second.voxels;
    tissue.box = {found->second.lower, found->second.upper};
    segmentation.tissues.push_back(std::move(tissue));
  }
  for (int layer = 0; layer < static_cast<int>(unclaimed.size()); ++layer)
    for (const auto& [label, extent] : unclaimed[layer]) {
      Tissue& tissue = segmentation.tissues.emplace_back(unnamedTissue(layer, label));
      tissue.voxels = extent.voxels;
      tissue.box = {extent.lower, extent.upper};
    }
  std::ranges::stable_sort(segmentation.tissues, {}, byLayerThenLabel);
  std::ranges::stable_sort(segmentation.emptyTissues, {}, byLayerThenLabel);
}

}  // namespace sinew
