#include "sinew/Mesher/RedGreenLattice.h"

#include "Parallel.h"

#include <stdexcept>
#include <utility>

namespace sinew {
namespace {

constexpr std::size_t kLatticeGrain = 512;  // tets or midpoints per task

}  // namespace

RedGreenLattice::RedGreenLattice(Int3 coarseCells, int levels)
    : coarseCells_(coarseCells),
      levels_(levels),
      nodes_((coarseCells << (levels - 1)) + Int3{1, 1, 1}),
      fresh_(levels) {
  insertCoarseNodes();
}

void RedGreenLattice::insertCoarseNodes() {
  const int shift = levels_ - 1;
  for (int z = 0; z <= coarseCells_.z; ++z) {
    for (int y = 0; y <= coarseCells_.y; ++y) {
      for (int x = 0; x <= coarseCells_.x; ++x) {
        nodes_.insert(Int3{2 * x, 2 * y, 2 * z} << shift);
        if (x < coarseCells_.x && y < coarseCells_.y && z < coarseCells_.z) {
          nodes_.insert(Int3{2 * x + 1, 2 * y + 1, 2 * z + 1} << shift);
        }
      }
    }
  }
}

unsigned RedGreenLattice::bisectedEdges(int level, const BccTet& tet) const {
  const int shift = levels_ - 2 - level;
  const std::array<Int3, 4> nodes = bccNodes(tet);
  unsigned mask = 0;
  for (int e = 0; e < 6; ++e) {
    const Int3 midpoint = (nodes[kTetEdges[e][0]] + nodes[kTetEdges[e][1]]) << shift;
    mask |= static_cast<unsigned>(nodes_.contains(midpoint)) << e;
  }
  return mask;
}

template <class BisectionAt>
void RedGreenLattice::bisect(std::size_t count, const BisectionAt& bisectionAt) {
  // Calls f(level, midpoint in half cubes of the next level, the same in those of the finest).
  const auto forEachMidpoint = [&](const Bisection& b, const auto& f) {
    const std::array<Int3, 4> nodes = bccNodes(b.at.tet);
    for (int e = 0; e < 6; ++e) {
      if ((b.edges >> e & 1U) == 0) continue;
      const Int3 q = nodes[kTetEdges[e][0]] + nodes[kTetEdges[e][1]];
      f(b.at.level, q, q << (levels_ - 2 - b.at.level));
    }
  };
  nodes_.addPages(collect<std::size_t>(
      count,
      [&](std::size_t i, std::vector<std::size_t>& pages) {
        forEachMidpoint(bisectionAt(i), [&](int, Int3, Int3 p) {
          requireInside(p);
          const std::size_t page = nodes_.pageIndex(p);
          if (!nodes_.hasPage(page) && (pages.empty() || pages.back() != page)) pages.push_back(page);
        });
      },
      kLatticeGrain));
  const auto fresh = collect<std::pair<int, Int3>>(
      count,
      [&](std::size_t i, auto& found) {
        forEachMidpoint(bisectionAt(i), [&](int level, Int3 q, Int3 p) {
          if (nodes_.insertConcurrently(p)) found.emplace_back(level, q);
        });
      },
      kLatticeGrain);
  for (const auto& [level, q] : fresh) fresh_[level].push_back(q);
}

void RedGreenLattice::refine(const std::vector<LevelTet>& tets) {
  bisect(tets.size(), [&](std::size_t i) { return Bisection{tets[i], kAllEdges}; });
}

void RedGreenLattice::requireInside(Int3 p) const {
  const int cube = 2 << (levels_ - 1);
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < cube || p[axis] > cube * (coarseCells_[axis] - 1)) {
      throw std::logic_error("RedGreenLattice: refinement reaches the border of the block");
    }
  }
}

void RedGreenLattice::close(int level, Int3 midpoint, std::vector<Bisection>& wanted) const {
  for (const BccTet& tet : tetsAroundEdge(midpoint)) {
    const unsigned mask = bisectedEdges(level, tet);
    const unsigned missing = kClosedPatterns[mask] & ~mask;
    if (missing != 0) wanted.push_back({{level, tet}, missing});
    if (level == 0) continue;
    const LevelTet parent{level - 1, redParent(tet)};
    const unsigned whole = kAllEdges & ~bisectedEdges(parent.level, parent.tet);
    if (whole != 0) wanted.push_back({parent, whole});
  }
}

void RedGreenLattice::close() {
  for (int level = levels_ - 2; level >= 0; --level) {
    while (!fresh_[level].empty()) {
      // Which midpoints are fresh does not depend on the threads, only their order does.
      const std::vector<Int3> fresh = std::exchange(fresh_[level], {});
      const auto wanted = collect<Bisection>(
          fresh.size(), [&](std::size_t n, auto& found) { close(level, fresh[n], found); }, kLatticeGrain);
      bisect(wanted.size(), [&](std::size_t i) { return wanted[i]; });
    }
  }
  nodes_.rank();
}

std::array<BccTet, 12> RedGreenLattice::coarseTets(Int3 cell) {
  std::array<BccTet, 12> tets;
  for (int o = 0; o < kBccOrientations; ++o) {
    tets[o] = {2 * cell, o};
    tets[o].m[o / 4] += 1;
  }
  return tets;
}

}  // namespace sinew
