#pragma once

#include "sinew/Mesher/RedGreenLattice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace sinew::test {

/// Exact integer geometry of lattice points, and a whole hierarchy as a list of leaves.
struct Int3Less {
  bool operator()(Int3 a, Int3 b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
};

constexpr std::int64_t dot(Int3 a, Int3 b) {
  return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z;
}
constexpr Int3 cross(Int3 a, Int3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// (b-a)x(c-a).(d-a)
constexpr std::int64_t sixVolume(const std::array<Int3, 4>& p) {
  return dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
}

/// A face by its points in ascending order.
using LatticeFace = std::array<std::array<int, 3>, 3>;

/// Counts the tets at the faces of one tet.
inline void countFaces(const std::array<Int3, 4>& nodes, std::map<LatticeFace, int>& tetsAtFace) {
  for (const auto& corners : kTetFaces) {
    LatticeFace face;
    for (int c = 0; c < 3; ++c) face[c] = {nodes[corners[c]].x, nodes[corners[c]].y, nodes[corners[c]].z};
    std::sort(face.begin(), face.end());
    ++tetsAtFace[face];
  }
}

/// The tets of level 0 in the cubes that are complete: 1 .. n - 2 along each axis.
inline std::vector<BccTet> coarseTetsOf(Int3 n) {
  std::vector<BccTet> tets;
  for (int z = 1; z < n.z - 1; ++z)
    for (int y = 1; y < n.y - 1; ++y)
      for (int x = 1; x < n.x - 1; ++x)
        for (const BccTet& tet : RedGreenLattice::coarseTets({x, y, z})) tets.push_back(tet);
  return tets;
}

/// All leaves below coarseTetsOf.
inline std::vector<LatticeTet> allLeaves(const RedGreenLattice& lattice) {
  std::vector<LatticeTet> leaves;
  const auto everywhere = [](int, const std::array<Int3, 4>&) { return true; };
  for (const BccTet& tet : coarseTetsOf(lattice.coarseCells()))
    lattice.forEachLeaf(0, tet, everywhere, [&](const LatticeTet& leaf) { leaves.push_back(leaf); });
  return leaves;
}

}  // namespace sinew::test
