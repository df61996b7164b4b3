#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <array>
#include <bit>
#include <cstdint>

namespace sinew {

/// The green patterns of Teran et al. 2005, section 4, as tables over the 6-bit set of bisected edges of a
/// red tet (bit e: kTetEdges[e]). Allowed: none, one edge, two opposite edges, the three edges of one face,
/// all six (red).
///
/// The children are written in local points: 0..3 the nodes, 4 + e the midpoint of edge e. Replacing one end
/// of an edge by its midpoint keeps the orientation, so every child of a positive tet is positive.
using LocalTet = std::array<std::uint8_t, 4>;

struct GreenPattern {
  int count = 0;  ///< children; 0 when the pattern is not allowed
  std::array<LocalTet, 4> tets{};
};

inline constexpr unsigned kAllEdges = 0b111111;

/// Bit set of the three edges of the face opposite to node v.
constexpr unsigned faceEdges(int v) {
  unsigned edges = 0;
  for (int e = 0; e < 6; ++e) {
    if (kTetEdges[e][0] != v && kTetEdges[e][1] != v) edges |= 1U << e;
  }
  return edges;
}

/// The smallest allowed pattern that contains `mask`, where no smaller one exists all six edges.
constexpr unsigned closePattern(unsigned mask) {
  const int bits = std::popcount(mask);
  if (bits <= 1 || mask == kAllEdges) return mask;
  if (bits == 2) {
    for (int e = 0; e < 3; ++e) {
      if (mask == ((1U << e) | (1U << (5 - e)))) return mask;
    }
  }
  for (int v = 0; v < 4; ++v) {
    if ((mask & ~faceEdges(v)) == 0) return faceEdges(v);
  }
  return kAllEdges;
}

constexpr GreenPattern makeGreenPattern(unsigned mask) {
  GreenPattern pattern;
  if (closePattern(mask) != mask || mask == kAllEdges) return pattern;
  const LocalTet whole{0, 1, 2, 3};
  const auto midpoint = [](int a, int b) {
    for (int e = 0; e < 6; ++e) {
      if (kTetEdges[e] == std::array<int, 2>{a < b ? a : b, a < b ? b : a})
        return static_cast<std::uint8_t>(4 + e);
    }
    return std::uint8_t{0};
  };
  if (std::popcount(mask) == 3) {
    for (int v = 0; v < 4; ++v) {
      if (mask != faceEdges(v)) continue;
      const int a = kTetFaces[v][0], b = kTetFaces[v][1], c = kTetFaces[v][2];
      const std::array<std::array<int, 3>, 3> corners{{{a, b, c}, {b, c, a}, {c, a, b}}};
      LocalTet middle = whole;
      for (const auto& [p, q, r] : corners) {
        LocalTet child = whole;  // the corner p keeps its node, q and r move to the midpoints next to p
        child[q] = midpoint(p, q);
        child[r] = midpoint(p, r);
        pattern.tets[pattern.count++] = child;
        middle[p] = midpoint(p, q);
      }
      pattern.tets[pattern.count++] = middle;
    }
    return pattern;
  }
  pattern.tets[pattern.count++] = whole;
  for (int e = 0; e < 6; ++e) {
    if ((mask >> e & 1U) == 0) continue;
    const int before = pattern.count;
    for (int t = 0; t < before; ++t) {
      LocalTet second = pattern.tets[t];
      pattern.tets[t][kTetEdges[e][0]] = static_cast<std::uint8_t>(4 + e);
      second[kTetEdges[e][1]] = static_cast<std::uint8_t>(4 + e);
      pattern.tets[pattern.count++] = second;
    }
  }
  return pattern;
}

/// Table over all 64 sets of bisected edges.
inline constexpr std::array<GreenPattern, 64> kGreenPatterns = [] {
  std::array<GreenPattern, 64> table{};
  for (unsigned mask = 0; mask < 64; ++mask) table[mask] = makeGreenPattern(mask);
  return table;
}();

/// closePattern as a table.
inline constexpr std::array<std::uint8_t, 64> kClosedPatterns = [] {
  std::array<std::uint8_t, 64> table{};
  for (unsigned mask = 0; mask < 64; ++mask) table[mask] = static_cast<std::uint8_t>(closePattern(mask));
  return table;
}();

}  // namespace sinew
