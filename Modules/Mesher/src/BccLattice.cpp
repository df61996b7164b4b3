#include "sinew/Mesher/BccLattice.h"

namespace sinew {
namespace {

constexpr Int3 unit(int axis) {
  Int3 e;
  e[axis] = 1;
  return e;
}

/// The axes and the sign behind an orientation number.
struct Frame {
  int i, j, k, sigma;
};

constexpr Frame frameOf(int orientation) {
  const int i = orientation / 4;
  const bool far = (orientation & 2) != 0;
  return {i, (i + (far ? 1 : 2)) % 3, (i + (far ? 2 : 1)) % 3, (orientation & 1) != 0 ? 1 : -1};
}

constexpr int orientationOf(int i, int k, int sigma) { return 4 * i + 2 * (k == (i + 2) % 3) + (sigma > 0); }

constexpr std::array<std::array<Int3, 4>, kBccOrientations> makeNodes() {
  std::array<std::array<Int3, 4>, kBccOrientations> table{};
  for (int o = 0; o < kBccOrientations; ++o) {
    const Frame f = frameOf(o);
    const Int3 b = f.sigma * unit(f.k);
    // (a1-a0)x(b0-a0).(b1-a0) = -4 sigma e_i.(e_j x e_k): swap the odd nodes where that is negative.
    const int parity = f.j == (f.i + 1) % 3 ? 1 : -1;
    const int s = f.sigma * parity < 0 ? 1 : -1;
    table[o] = {-1 * unit(f.i), unit(f.i), b - s * unit(f.j), b + s * unit(f.j)};
  }
  return table;
}

constexpr auto kNodes = makeNodes();

/// Local points of a refined tet: its nodes 0..3 and the midpoints 4..9 of kTetEdges 0..5.
constexpr std::array<std::array<int, 4>, kRedChildren> kChildPoints{{
    {0, 4, 5, 6},
    {1, 4, 7, 8},
    {2, 5, 7, 9},
    {3, 6, 8, 9},  // at the four nodes
    {4, 9, 5, 7},
    {4, 9, 7, 8},
    {4, 9, 8, 6},
    {4, 9, 6, 5}  // around the diagonal between the long edges' midpoints
}};

/// Children relative to twice the parent's m.
constexpr std::array<std::array<BccTet, kRedChildren>, kBccOrientations> makeChildren() {
  constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  std::array<std::array<BccTet, kRedChildren>, kBccOrientations> table{};
  for (int o = 0; o < kBccOrientations; ++o) {
    // m has one odd coordinate; put it there so that the parities, hence the classes of the nodes, are right.
    const Int3 m = unit(frameOf(o).i);
    std::array<Int3, 10> points{};
    for (int v = 0; v < 4; ++v) points[v] = 2 * (m + kNodes[o][v]);
    for (int e = 0; e < 6; ++e) points[4 + e] = (m + kNodes[o][edges[e][0]]) + (m + kNodes[o][edges[e][1]]);
    for (int c = 0; c < kRedChildren; ++c) {
      std::array<Int3, 4> nodes{};
      for (int v = 0; v < 4; ++v) nodes[v] = points[kChildPoints[c][v]] + Int3{4, 4, 4};
      BccTet child = bccTetFromNodes(nodes);
      child.m = child.m - Int3{4, 4, 4} - 2 * m;
      table[o][c] = child;
    }
  }
  return table;
}

constexpr auto kChildren = makeChildren();

/// Where a child of a given orientation and position modulo 4 sits in its parent.
struct ParentEntry {
  Int3 offset;           ///< child.m - 2 parent.m
  int orientation = -1;  ///< of the parent
};

constexpr int residue(Int3 m) { return (m.x & 3) + 4 * (m.y & 3) + 16 * (m.z & 3); }

constexpr std::array<std::array<ParentEntry, 64>, kBccOrientations> makeParents() {
  std::array<std::array<ParentEntry, 64>, kBccOrientations> table{};
  for (int o = 0; o < kBccOrientations; ++o) {
    const Int3 m = unit(frameOf(o).i);
    for (const BccTet& child : kChildren[o])
      table[child.orientation][residue(2 * m + child.m)] = {child.m, o};
  }
  return table;
}

constexpr auto kParents = makeParents();

}  // namespace

const std::array<std::array<Int3, 4>, kBccOrientations> kBccNodes = kNodes;

std::array<Int3, 4> bccNodes(const BccTet& tet) {
  const auto& offsets = kNodes[tet.orientation];
  return {tet.m + offsets[0], tet.m + offsets[1], tet.m + offsets[2], tet.m + offsets[3]};
}

std::array<BccTet, kRedChildren> redChildren(const BccTet& tet) {
  std::array<BccTet, kRedChildren> children = kChildren[tet.orientation];
  for (BccTet& child : children) child.m = child.m + 2 * tet.m;
  return children;
}

BccTet redParent(const BccTet& child) {
  const ParentEntry& entry = kParents[child.orientation][residue(child.m)];
  const Int3 twice = child.m - entry.offset;
  return {{twice.x / 2, twice.y / 2, twice.z / 2}, entry.orientation};
}

EdgeStar tetsAroundEdge(Int3 q) {
  EdgeStar star;
  const auto add = [&](Int3 m, int i, int k, int sigma) {
    star.tets[star.count++] = {m, orientationOf(i, k, sigma)};
  };
  if ((q.x & 1) != 0) {  // short edge from the even node a to the odd node a + s
    Int3 a, s;
    for (int axis = 0; axis < 3; ++axis) {
      const int lower = (q[axis] - 1) / 2;
      s[axis] = (lower & 1) == 0 ? 1 : -1;
      a[axis] = (lower & 1) == 0 ? lower : lower + 1;
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        if (k != i) add(a + s[i] * unit(i), i, k, s[k]);
      }
    }
    return star;
  }
  const Int3 mid{q.x / 2, q.y / 2, q.z / 2};
  const int odds = (mid.x & 1) + (mid.y & 1) + (mid.z & 1);
  const bool evenEdge = odds == 1;
  int along = 0;  // the axis of the edge: the odd coordinate of an even edge, the even one of an odd edge
  while (((mid[along] & 1) != 0) != evenEdge) ++along;
  for (int k = 0; k < 3; ++k) {
    if (k == along) continue;
    for (int sigma : {-1, 1}) {
      if (evenEdge) {
        add(mid, along, k, sigma);
      } else {
        add(mid - sigma * unit(k), 3 - along - k, k, sigma);
      }
    }
  }
  return star;
}

}  // namespace sinew
