#include "sinew/Segmentation/LabelComponents.h"

#include <algorithm>
#include <numeric>

namespace sinew {
namespace {

/// Voxels begin <= i < end of one row; `parent` makes the runs a forest of pieces.
struct Run {
  std::int32_t begin, end;
  std::int32_t parent;
};

/// The tissue as runs along x, row by row: far fewer than voxels, and all that connectivity needs.
class RunForest {
 public:
  RunForest(const Segmentation& segmentation, const Tissue& tissue)
      : size_(tissue.box.upper - tissue.box.lower) {
    const auto& layer = segmentation.layers[tissue.layer];
    const Eigen::Vector3i& image = segmentation.geometry.size;
    firstRun_.push_back(0);
    for (int k = 0; k < size_.z(); ++k)
      for (int j = 0; j < size_.y(); ++j) {
        const Eigen::Vector3i start = tissue.box.lower + Eigen::Vector3i(0, j, k);
        const std::int64_t offset = start.x() + image.x() * (start.y() + std::int64_t{image.y()} * start.z());
        addRow(layer.data() + offset, tissue.label);
        joinRow(j, k);
      }
  }

  const std::vector<Run>& runs() const { return runs_; }
  std::int64_t firstRunOfRow(std::int64_t row) const { return firstRun_[row]; }

  std::int32_t root(std::int32_t run) {
    while (runs_[run].parent != run) run = runs_[run].parent = runs_[runs_[run].parent].parent;
    return run;
  }

 private:
  void addRow(const std::int32_t* row, std::int32_t label) {
    for (int i = 0; i < size_.x(); ++i) {
      if (row[i] != label) continue;
      const int begin = i;
      while (i < size_.x() && row[i] == label) ++i;
      runs_.push_back({begin, i, static_cast<std::int32_t>(runs_.size())});
    }
    firstRun_.push_back(static_cast<std::int64_t>(runs_.size()));
  }

  /// Joins row (j, k) to the four rows before it that touch it.
  void joinRow(int j, int k) {
    constexpr std::array<std::array<int, 2>, 4> earlier{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    for (const auto& [dj, dk] : earlier)
      if (j + dj >= 0 && j + dj < size_.y() && k + dk >= 0)
        joinRows(j + std::int64_t{size_.y()} * k, j + dj + std::int64_t{size_.y()} * (k + dk));
  }

  void joinRows(std::int64_t row, std::int64_t other) {
    std::int64_t a = firstRun_[row], b = firstRun_[other];
    while (a < firstRun_[row + 1] && b < firstRun_[other + 1]) {
      const bool touch = runs_[a].begin <= runs_[b].end && runs_[b].begin <= runs_[a].end;  // corners count
      if (touch) join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
      ++(runs_[a].end < runs_[b].end ? a : b);
    }
  }

  /// The first run of a piece stays its root.
  void join(std::int32_t a, std::int32_t b) {
    const auto [first, second] = std::minmax({root(a), root(b)});
    runs_[second].parent = first;
  }

  Eigen::Vector3i size_;
  std::vector<Run> runs_;
  std::vector<std::int64_t> firstRun_;  // of every row, and the end
};

/// Numbers the pieces by size, the earlier one first among equals. @return id of every root, -1 elsewhere
std::vector<std::int32_t> rankPieces(RunForest& forest, std::vector<std::int64_t>& voxels) {
  const std::vector<Run>& runs = forest.runs();
  std::vector<std::int64_t> size(runs.size(), 0);
  std::vector<std::int32_t> roots;
  for (std::int32_t r = 0; r < std::ssize(runs); ++r) {
    const std::int32_t root = forest.root(r);
    if (root == r) roots.push_back(r);
    size[root] += runs[r].end - runs[r].begin;
  }
  std::ranges::stable_sort(roots, std::ranges::greater{}, [&](std::int32_t r) { return size[r]; });
  std::vector<std::int32_t> ids(runs.size(), -1);
  for (const std::int32_t root : roots) {
    ids[root] = static_cast<std::int32_t>(voxels.size());
    voxels.push_back(size[root]);
  }
  return ids;
}

}  // namespace

std::int32_t LabelComponents::at(const Eigen::Vector3i& index) const {
  if ((index.array() < box.lower.array()).any() || (index.array() >= box.upper.array()).any()) return -1;
  const Eigen::Vector3i i = index - box.lower, size = box.upper - box.lower;
  return ids[i.x() + size.x() * (i.y() + std::int64_t{size.y()} * i.z())];
}

LabelComponents labelComponents(const Segmentation& segmentation, const Tissue& tissue) {
  LabelComponents components{.box = tissue.box, .ids = {}, .voxels = {}};
  if (tissue.box.empty()) return components;
  RunForest forest(segmentation, tissue);
  const std::vector<std::int32_t> ids = rankPieces(forest, components.voxels);

  const Eigen::Vector3i size = tissue.box.upper - tissue.box.lower;
  components.ids.assign(size.cast<std::int64_t>().prod(), -1);
  std::int32_t* row = components.ids.data();
  const std::int64_t rows = std::int64_t{size.y()} * size.z();
  for (std::int64_t r = 0; r < rows; ++r, row += size.x())
    for (std::int64_t run = forest.firstRunOfRow(r); run < forest.firstRunOfRow(r + 1); ++run)
      std::fill(row + forest.runs()[run].begin, row + forest.runs()[run].end,
                ids[forest.root(static_cast<std::int32_t>(run))]);
  return components;
}

}  // namespace sinew
