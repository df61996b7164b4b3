#include "sinew/LevelSet/FieldPieces.h"

#include <algorithm>
#include <numeric>

namespace sinew {
namespace {

/// Runs of samples along x that belong to one side, joined by union-find: far fewer than samples.
struct Run {
  int begin, end;  ///< half open
};

class Runs {
 public:
  Runs(const DenseField& phi, bool inside) : size_(phi.size), first_(1, 0) {
    for (int k = 0; k < size_.z(); ++k)
      for (int j = 0; j < size_.y(); ++j) {
        const float* row = phi.row(j, k);
        for (int i = 0; i < size_.x();) {
          while (i < size_.x() && (row[i] < 0) != inside) ++i;
          const int begin = i;
          while (i < size_.x() && (row[i] < 0) == inside) ++i;
          if (i > begin) runs_.push_back({begin, i});
        }
        first_.push_back(runs_.size());
      }
    parent_.resize(runs_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// Joins the runs of the rows (j, k) and (j + dj, k + dk) that touch; `reach` 1 counts corners too.
  void joinRows(int j, int k, int dj, int dk, int reach) {
    if (j + dj < 0 || j + dj >= size_.y() || k + dk >= size_.z()) return;
    const std::size_t row = rowOf(j, k), other = rowOf(j + dj, k + dk);
    for (std::size_t a = first_[row], b = first_[other]; a < first_[row + 1] && b < first_[other + 1];) {
      if (runs_[a].begin < runs_[b].end + reach && runs_[b].begin < runs_[a].end + reach) join(a, b);
      runs_[a].end < runs_[b].end ? ++a : ++b;
    }
  }

  FieldPieces pieces() {
    FieldPieces result{DenseRaster<std::int32_t>(size_, -1), {}, {}};
    std::vector<std::int32_t> number(runs_.size(), -1);
    for (int k = 0; k < size_.z(); ++k)
      for (int j = 0; j < size_.y(); ++j)
        for (std::size_t r = first_[rowOf(j, k)]; r < first_[rowOf(j, k) + 1]; ++r) {
          std::int32_t& id = number[root(r)];
          if (id < 0) {
            id = static_cast<std::int32_t>(result.samples.size());
            result.samples.push_back(0);
            result.atBorder.push_back(0);
          }
          const Run& run = runs_[r];
          result.samples[id] += run.end - run.begin;
          if (j == 0 || k == 0 || j + 1 == size_.y() || k + 1 == size_.z() || run.begin == 0 ||
              run.end == size_.x())
            result.atBorder[id] = 1;
          std::fill(result.ids.row(j, k) + run.begin, result.ids.row(j, k) + run.end, id);
        }
    return result;
  }

 private:
  std::size_t rowOf(int j, int k) const {
    return static_cast<std::size_t>(j) + static_cast<std::size_t>(size_.y()) * static_cast<std::size_t>(k);
  }
  std::size_t root(std::size_t r) {
    while (parent_[r] != r) r = parent_[r] = parent_[parent_[r]];
    return r;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

  Eigen::Vector3i size_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_;  ///< of each row, and one behind the last
  std::vector<std::size_t> parent_;
};

}  // namespace

FieldPieces fieldPieces(const DenseField& phi, bool inside, Connectivity connectivity) {
  const bool corners = connectivity == Connectivity::Corners;
  const int reach = corners ? 1 : 0;
  Runs runs(phi, inside);
  for (int k = 0; k < phi.size.z(); ++k)
    for (int j = 0; j < phi.size.y(); ++j) {
      runs.joinRows(j, k, 1, 0, reach);
      runs.joinRows(j, k, 0, 1, reach);
      if (!corners) continue;
      runs.joinRows(j, k, 1, 1, reach);
      runs.joinRows(j, k, -1, 1, reach);
    }
  return runs.pieces();
}

}  // namespace sinew
