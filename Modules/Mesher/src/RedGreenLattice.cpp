#include "sinew/Mesher/RedGreenLattice.h"

#include <stdexcept>

namespace sinew {

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

void RedGreenLattice::bisect(int level, const BccTet& tet, unsigned edges) {
  const int shift = levels_ - 2 - level;
  const std::array<Int3, 4> nodes = bccNodes(tet);
  for (int e = 0; e < 6; ++e) {
    if ((edges >> e & 1U) == 0) continue;
    const Int3 q = nodes[kTetEdges[e][0]] + nodes[kTetEdges[e][1]];
    if (!nodes_.insert(q << shift)) continue;
    requireInside(q << shift);
    fresh_[level].push_back(q);
  }
}

void RedGreenLattice::requireInside(Int3 p) const {
  const int cube = 2 << (levels_ - 1);
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < cube || p[axis] > cube * (coarseCells_[axis] - 1)) {
      throw std::logic_error("RedGreenLattice: refinement reaches the border of the block");
    }
  }
}

void RedGreenLattice::close() {
  for (int level = levels_ - 2; level >= 0; --level) {
    std::vector<Int3>& fresh = fresh_[level];
    for (std::size_t n = 0; n < fresh.size(); ++n) {  // grows while it runs
      for (const BccTet& tet : tetsAroundEdge(fresh[n])) {
        const unsigned mask = bisectedEdges(level, tet);
        bisect(level, tet, kClosedPatterns[mask] & ~mask);
        if (level > 0) bisect(level - 1, redParent(tet), kAllEdges);
      }
    }
    fresh.clear();
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
