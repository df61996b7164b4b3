#include "sinew/Mesher/BccLattice.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Mesher/RedGreen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr unsigned bit(int edge) { return 1U << edge; }

/// The patterns of the paper, written down by hand over kTetEdges 01 02 03 12 13 23.
const std::set<unsigned> kAllowed{0,
                                  bit(0),
                                  bit(1),
                                  bit(2),
                                  bit(3),
                                  bit(4),
                                  bit(5),
                                  bit(0) | bit(5),  // opposite edges
                                  bit(1) | bit(4),
                                  bit(2) | bit(3),
                                  bit(0) | bit(1) | bit(3),  // faces 012, 013, 023, 123
                                  bit(0) | bit(2) | bit(4),
                                  bit(1) | bit(2) | bit(5),
                                  bit(3) | bit(4) | bit(5),
                                  kAllEdges};

/// Local points of a tet: its nodes and the midpoints of its edges.
std::array<Vector3d, 10> localPoints(const std::array<Int3, 4>& nodes) {
  std::array<Vector3d, 10> x;
  for (int v = 0; v < 4; ++v) x[v] = Vector3d(nodes[v].x, nodes[v].y, nodes[v].z);
  for (int e = 0; e < 6; ++e) x[4 + e] = (x[kTetEdges[e][0]] + x[kTetEdges[e][1]]) / 2;
  return x;
}

using LocalFace = std::set<int>;

/// The triangles that a face must be cut into, by its own bisected edges alone: then neighbours agree.
std::set<LocalFace> cutFace(int face, unsigned mask) {
  const auto& [a, b, c] = kTetFaces[face];
  const auto midpoint = [&](int p, int q) {
    for (int e = 0; e < 6; ++e)
      if (std::set<int>{kTetEdges[e][0], kTetEdges[e][1]} == std::set<int>{p, q}) return e;
    return -1;
  };
  const std::array<std::array<int, 3>, 3> turns{{{a, b, c}, {b, c, a}, {c, a, b}}};
  std::set<LocalFace> cut, corners;
  LocalFace middle;
  for (const auto& [p, q, r] : turns) {
    const int pq = midpoint(p, q), pr = midpoint(p, r);
    if ((mask >> pq & 1) != 0) {
      cut.insert({{p, 4 + pq, r}, {q, 4 + pq, r}});
      middle.insert(4 + pq);
      corners.insert({p, 4 + pq, 4 + pr});
    }
  }
  if (middle.empty()) return {{a, b, c}};
  if (middle.size() == 1) return cut;
  corners.insert(middle);
  return corners;
}

TEST(RedGreen, OppositeEdgesAreNumberedEAndFiveMinusE) {
  for (int e = 0; e < 6; ++e) {
    const std::set<int> nodes{kTetEdges[e][0], kTetEdges[e][1], kTetEdges[5 - e][0], kTetEdges[5 - e][1]};
    EXPECT_EQ(nodes.size(), 4u);
  }
}

TEST(RedGreen, AllowedPatternsAreThoseOfThePaper) {
  for (unsigned mask = 0; mask < 64; ++mask) {
    EXPECT_EQ(closePattern(mask) == mask, kAllowed.contains(mask)) << mask;
    EXPECT_EQ(kGreenPatterns[mask].count > 0, kAllowed.contains(mask) && mask != kAllEdges) << mask;
    EXPECT_EQ(kClosedPatterns[mask], closePattern(mask)) << mask;
  }
}

TEST(RedGreen, ClosePatternGivesTheSmallestAllowedPattern) {
  for (unsigned mask = 0; mask < 64; ++mask) {
    unsigned meet = kAllEdges;
    for (const unsigned allowed : kAllowed)
      if ((mask & ~allowed) == 0) meet &= allowed;
    // Where the allowed patterns above a mask have no smallest one, the paper refines red.
    EXPECT_EQ(closePattern(mask), kAllowed.contains(meet) ? meet : kAllEdges) << mask;
  }
}

TEST(RedGreen, ClosePatternIsMonotoneAndIdempotent) {
  for (unsigned small = 0; small < 64; ++small) {
    EXPECT_EQ(closePattern(closePattern(small)), closePattern(small));
    for (unsigned large = 0; large < 64; ++large)
      if ((small & ~large) == 0) {
        EXPECT_EQ(closePattern(small) & ~closePattern(large), 0u) << small << ' ' << large;
      }
  }
}

TEST(RedGreen, NumbersOfChildren) {
  EXPECT_EQ(kGreenPatterns[0].count, 1);
  for (int e = 0; e < 6; ++e) EXPECT_EQ(kGreenPatterns[bit(e)].count, 2);
  for (int e = 0; e < 3; ++e) EXPECT_EQ(kGreenPatterns[bit(e) | bit(5 - e)].count, 4);
  for (int v = 0; v < 4; ++v) EXPECT_EQ(kGreenPatterns[faceEdges(v)].count, 4);
}

TEST(RedGreen, ChildrenFillTheParentAndCutItsFacesByTheFacesOwnEdges) {
  for (const unsigned mask : kAllowed) {
    if (mask == kAllEdges) continue;
    SCOPED_TRACE(mask);
    const GreenPattern& pattern = kGreenPatterns[mask];
    const std::array<Vector3d, 10> x = localPoints(kBccNodes[5]);
    std::map<LocalFace, int> tetsAtFace;
    double volume = 0;
    for (int c = 0; c < pattern.count; ++c) {
      const LocalTet& t = pattern.tets[c];
      const double part = tetQuality(x[t[0]], x[t[1]], x[t[2]], x[t[3]]).volume;
      EXPECT_GT(part, 0);
      volume += part;
      for (const auto& [i, j, k] : kTetFaces) ++tetsAtFace[{t[i], t[j], t[k]}];
    }
    EXPECT_NEAR(volume, 4.0 / 6, 1e-15);  // a^3 / 12 with a = 2; a handful of roundings

    std::set<LocalFace> outer, expected;
    for (const auto& [face, count] : tetsAtFace) {
      EXPECT_LE(count, 2);
      if (count == 1) outer.insert(face);
    }
    for (int f = 0; f < 4; ++f) expected.merge(cutFace(f, mask));
    EXPECT_EQ(outer, expected);
  }
}

/// Bounds of the children of one pattern over all orientations.
struct Bounds {
  double aspectRatio = 0, minDihedralDeg = 180, maxDihedralDeg = 0;
};

Bounds boundsOf(unsigned mask, int orientation) {
  const std::array<Vector3d, 10> x = localPoints(kBccNodes[orientation]);
  const GreenPattern& pattern = kGreenPatterns[mask];
  Bounds bounds;
  for (int c = 0; c < pattern.count; ++c) {
    const LocalTet& t = pattern.tets[c];
    const TetQuality q = tetQuality(x[t[0]], x[t[1]], x[t[2]], x[t[3]]);
    bounds.aspectRatio = std::max(bounds.aspectRatio, q.aspectRatio);
    bounds.minDihedralDeg = std::min(bounds.minDihedralDeg, q.minDihedralDeg);
    bounds.maxDihedralDeg = std::max(bounds.maxDihedralDeg, q.maxDihedralDeg);
  }
  return bounds;
}

TEST(RedGreen, ChildrenOfABccTetHaveTheExactBounds) {
  const auto degrees = [](double cosine) { return std::acos(cosine) * 180 / std::numbers::pi; };
  struct Case {
    std::string name;
    std::vector<unsigned> masks;
    Bounds bounds;
  };
  const std::vector<Case> cases{
      {"whole", {0}, {std::sqrt(2.0), 60, 90}},
      {"one long edge", {bit(0), bit(5)}, {std::sqrt(8.0), 45, 90}},
      {"one short edge",
       {bit(1), bit(2), bit(3), bit(4)},
       {std::sqrt(8.0), 30, degrees(-1 / std::sqrt(12.0))}},            // 106.78
      {"two long edges", {bit(0) | bit(5)}, {std::sqrt(6.0), 45, 90}},  // 2.449
      {"two short edges",
       {bit(1) | bit(4), bit(2) | bit(3)},
       {std::sqrt(8.0), 30, degrees(-1.0 / 3)}},  // 109.47
      {"face",
       {faceEdges(0), faceEdges(1), faceEdges(2), faceEdges(3)},
       {std::sqrt(10.0), degrees(std::sqrt(0.45)), degrees(-std::sqrt(0.2))}}};  // 47.87, 116.57
  for (const Case& c : cases)
    for (const unsigned mask : c.masks)
      for (int o = 0; o < kBccOrientations; ++o) {
        SCOPED_TRACE(c.name + ", orientation " + std::to_string(o) + ", mask " + std::to_string(mask));
        const Bounds found = boundsOf(mask, o);
        EXPECT_NEAR(found.aspectRatio, c.bounds.aspectRatio, 1e-12);
        EXPECT_NEAR(found.minDihedralDeg, c.bounds.minDihedralDeg, 1e-11);
        EXPECT_NEAR(found.maxDihedralDeg, c.bounds.maxDihedralDeg, 1e-11);
      }
}

}  // namespace
}  // namespace sinew
