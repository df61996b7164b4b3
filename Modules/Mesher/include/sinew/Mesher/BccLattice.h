#pragma once

#include <array>
#include <cstdint>

namespace sinew {

/// Integer point of the lattice.
struct Int3 {
  int x = 0, y = 0, z = 0;
  constexpr int& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr int operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend constexpr bool operator==(const Int3&, const Int3&) = default;
};
constexpr Int3 operator+(Int3 a, Int3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Int3 operator-(Int3 a, Int3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Int3 operator*(int s, Int3 a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Int3 operator<<(Int3 a, int bits) { return {a.x << bits, a.y << bits, a.z << bits}; }

/// The body-centred cubic lattice by integer arithmetic (Teran et al. 2005, section 3).
///
/// At one level, in units of half a cube, nodes are the all-even points (corners of the cubes) and the
/// all-odd points (their centres). Every tet joins a long edge between two even nodes, along axis i, with a
/// long edge between two odd nodes, along axis j; their midpoints are one unit apart along the third axis k:
///
///     b0 ---- b1     odd edge along j, midpoint  m + sigma e_k
///       \    /
///        m  .        even edge a0 a1 along i, midpoint m: one odd coordinate, that of axis i
///
/// So a tet is (m, i, k, sigma): four tets around each even edge, twelve per cube. All are congruent.
struct BccTet {
  Int3 m;               ///< midpoint of the even edge, in half cubes of the tet's level
  int orientation = 0;  ///< 4 i + 2 [k = i + 2 mod 3] + [sigma > 0], in 0..11
  friend constexpr bool operator==(const BccTet&, const BccTet&) = default;
};

inline constexpr int kBccOrientations = 12;
inline constexpr int kRedChildren = 8;

/// Nodes of a tet relative to its m, in half cubes: a0, a1, then the odd two in the order that makes the tet
/// positive. Edge 0 = (0,1) and edge 5 = (2,3) of kTetEdges are the long ones.
extern const std::array<std::array<Int3, 4>, kBccOrientations> kBccNodes;

/// A tet from its four nodes, in any order. The nodes must form a lattice tet.
constexpr BccTet bccTetFromNodes(const std::array<Int3, 4>& nodes) {
  std::array<Int3, 2> even{}, odd{};
  int evens = 0, odds = 0;
  for (const Int3& p : nodes) ((p.x & 1) == 0 ? even[evens++ & 1] : odd[odds++ & 1]) = p;
  BccTet tet;
  Int3 evenSum = even[0] + even[1], oddSum = odd[0] + odd[1];
  tet.m = {evenSum.x / 2, evenSum.y / 2, evenSum.z / 2};
  for (int i = 0; i < 3; ++i) {
    if (even[0][i] != even[1][i]) tet.orientation += 4 * i;
  }
  const int i = tet.orientation / 4;
  for (int k = 0; k < 3; ++k) {
    const int sigma = (oddSum[k] - evenSum[k]) / 2;
    if (sigma != 0) tet.orientation += 2 * (k == (i + 2) % 3) + (sigma > 0);
  }
  return tet;
}

/// The nodes of a tet, in half cubes of its level.
std::array<Int3, 4> bccNodes(const BccTet& tet);

/// The eight red children (1:8), in half cubes of the next finer level: twice the parent's coordinates. The
/// inner octahedron is cut along its shortest diagonal, between the midpoints of the two long edges, so that
/// all eight are lattice tets again.
std::array<BccTet, kRedChildren> redChildren(const BccTet& tet);

/// The red tet of the next coarser level that has `child` among its children.
BccTet redParent(const BccTet& child);

/// The tets of one level around the edge of that level whose midpoint is `q`, given in half cubes of the next
/// finer level (the sum of the two end nodes): 4 around a long edge, 6 around a short one.
struct EdgeStar {
  std::array<BccTet, 6> tets;
  int count = 0;
  const BccTet* begin() const { return tets.data(); }
  const BccTet* end() const { return tets.data() + count; }
};
EdgeStar tetsAroundEdge(Int3 q);

}  // namespace sinew
