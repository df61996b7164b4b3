#include "LatticeOracle.h"
#include "sinew/Mesher/BccLattice.h"
#include "sinew/Mesher/TetMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace sinew {
namespace {

using test::countFaces;
using test::cross;
using test::dot;
using test::Int3Less;
using test::LatticeFace;
using test::sixVolume;

struct BccTetLess {
  bool operator()(const BccTet& a, const BccTet& b) const {
    if (a.m == b.m) return a.orientation < b.orientation;
    return Int3Less{}(a.m, b.m);
  }
};
using TetSet = std::set<BccTet, BccTetLess>;
using PointSet = std::set<Int3, Int3Less>;

/// All tets with m in [-reach, reach]^3, from the definition alone: m has one odd coordinate, that of axis i.
TetSet tetsAround(int reach) {
  TetSet tets;
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        for (int o = 0; o < kBccOrientations; ++o) {
          const Int3 m{x, y, z};
          if ((x & 1) + (y & 1) + (z & 1) == 1 && (m[o / 4] & 1) != 0) tets.insert({m, o});
        }
  return tets;
}

/// One tet per orientation, at a place of its own, negative coordinates included.
std::vector<BccTet> sampleTets() {
  std::vector<BccTet> tets;
  for (const Int3 corner : {Int3{0, 0, 0}, Int3{2, 0, -6}, Int3{-4, 2, 2}, Int3{6, 10, 4}, Int3{-2, -2, -8}})
    for (int o = 0; o < kBccOrientations; ++o) {
      BccTet tet{corner, o};
      tet.m[o / 4] += 1;
      tets.push_back(tet);
    }
  return tets;
}

int squaredLength(Int3 v) { return static_cast<int>(dot(v, v)); }

TEST(BccLattice, EveryNodeHasSixLongAndEightShortEdgesAndTwentyFourTets) {
  const TetSet tets = tetsAround(5);
  for (const Int3 node : {Int3{0, 0, 0}, Int3{1, 1, 1}, Int3{-2, 0, 2}, Int3{-1, 1, -1}}) {
    PointSet longEnds, shortEnds;
    int incident = 0;
    for (const BccTet& tet : tets) {
      const auto nodes = bccNodes(tet);
      if (std::ranges::find(nodes, node) == nodes.end()) continue;
      ++incident;
      for (const Int3 other : nodes) {
        const int length2 = squaredLength(other - node);
        if (length2 == 4) longEnds.insert(other);
        if (length2 == 3) shortEnds.insert(other);
        EXPECT_TRUE(length2 == 0 || length2 == 3 || length2 == 4) << length2;
      }
    }
    EXPECT_EQ(longEnds.size(), 6u);
    EXPECT_EQ(shortEnds.size(), 8u);
    EXPECT_EQ(incident, 24);
  }
}

TEST(BccLattice, TwelveTetsPerCubeMeetFaceToFace) {
  std::map<LatticeFace, int> tetsAtFace;
  const TetSet tets = tetsAround(4);
  for (const BccTet& tet : tets) countFaces(bccNodes(tet), tetsAtFace);
  for (const auto& [face, count] : tetsAtFace) {
    const bool inner = std::ranges::all_of(face, [](const auto& p) {
      return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) <= 2;
    });
    EXPECT_LE(count, 2);
    if (inner) {
      EXPECT_EQ(count, 2);
    }
  }
  // The lattice repeats with the cube, two half cubes: midpoints modulo 2 tell its tets apart.
  const auto perCube = std::ranges::count_if(tets, [](const BccTet& tet) {
    return tet.m.x >= 0 && tet.m.x < 2 && tet.m.y >= 0 && tet.m.y < 2 && tet.m.z >= 0 && tet.m.z < 2;
  });
  EXPECT_EQ(perCube, 12);
}

TEST(BccLattice, AllTetsArePositiveAndCongruent) {
  for (int o = 0; o < kBccOrientations; ++o) {
    const auto& p = kBccNodes[o];
    const std::int64_t volume6 = sixVolume(p);
    EXPECT_EQ(volume6, 4) << o;  // 6 a^3 / 12 with a = 2 half cubes
    for (int e = 0; e < 6; ++e) {
      const bool isLong = e == 0 || e == 5;
      EXPECT_EQ(squaredLength(p[kTetEdges[e][1]] - p[kTetEdges[e][0]]), isLong ? 4 : 3) << o << ' ' << e;
    }
    std::array<Int3, 4> normal;
    std::int64_t largest = 0;
    for (int f = 0; f < 4; ++f) {
      const auto& [i, j, k] = kTetFaces[f];
      normal[f] = cross(p[j] - p[i], p[k] - p[i]);
      largest = std::max(largest, dot(normal[f], normal[f]));
    }
    EXPECT_EQ(4 * largest, 2 * volume6 * volume6) << o;  // AR^2 = longest^2 |n|^2 / (6V)^2 = 2
    int right = 0, sixty = 0;
    for (const auto& [f, g] : kTetEdges) {
      const std::int64_t cosine = -dot(normal[f], normal[g]);  // times |n_f| |n_g|
      right += cosine == 0;
      sixty += cosine > 0 && 4 * cosine * cosine == dot(normal[f], normal[f]) * dot(normal[g], normal[g]);
    }
    EXPECT_EQ(right, 2) << o;
    EXPECT_EQ(sixty, 4) << o;
  }
}

TEST(BccLattice, ATetIsKnownByItsNodesInAnyOrder) {
  for (const BccTet& tet : sampleTets()) {
    std::array<Int3, 4> nodes = bccNodes(tet);
    std::ranges::sort(nodes, Int3Less{});
    do {
      EXPECT_EQ(bccTetFromNodes(nodes), tet);
    } while (std::next_permutation(nodes.begin(), nodes.end(), Int3Less{}));
  }
}

TEST(BccLattice, RedChildrenAreEightBccTetsThatFillTheirParent) {
  for (const BccTet& parent : sampleTets()) {
    std::array<Int3, 4> outer = bccNodes(parent);
    for (Int3& p : outer) p = 2 * p;
    std::int64_t volume6 = 0;
    std::map<LatticeFace, int> tetsAtFace;
    for (const BccTet& child : redChildren(parent)) {
      const int axis = child.orientation / 4;
      EXPECT_EQ((child.m.x & 1) + (child.m.y & 1) + (child.m.z & 1), 1);
      EXPECT_NE(child.m[axis] & 1, 0);
      const auto nodes = bccNodes(child);
      volume6 += sixVolume(nodes);
      countFaces(nodes, tetsAtFace);
      for (const auto& [i, j, k] : kTetFaces) {
        const Int3 normal = cross(outer[j] - outer[i], outer[k] - outer[i]);
        for (const Int3 p : nodes) EXPECT_LE(dot(normal, p - outer[i]), 0);
      }
    }
    EXPECT_EQ(volume6, sixVolume(outer));
    // Inside, of the whole volume, and without overlap: 16 faces outside, 8 inside shared by two.
    EXPECT_EQ(std::ranges::count(tetsAtFace, 1, [](const auto& entry) { return entry.second; }), 16);
    EXPECT_EQ(std::ranges::count(tetsAtFace, 2, [](const auto& entry) { return entry.second; }), 8);
  }
}

TEST(BccLattice, RedParentUndoesRedChildren) {
  for (const BccTet& parent : sampleTets())
    for (const BccTet& child : redChildren(parent)) {
      EXPECT_EQ(redParent(child), parent);
      for (const BccTet& grandchild : redChildren(child)) EXPECT_EQ(redParent(grandchild), child);
    }
}

TEST(BccLattice, EveryTetIsAChildOfItsParent) {
  for (const BccTet& tet : tetsAround(4)) {
    const auto siblings = redChildren(redParent(tet));
    EXPECT_EQ(std::ranges::count(siblings, tet), 1);
  }
}

TEST(BccLattice, TetsAroundAnEdgeAreThoseThatASearchFinds) {
  std::map<Int3, TetSet, Int3Less> around;  // by the sum of the edge's ends
  std::map<Int3, Int3, Int3Less> direction;
  for (const BccTet& tet : tetsAround(6)) {
    const auto nodes = bccNodes(tet);
    for (const auto& [a, b] : kTetEdges) {
      around[nodes[a] + nodes[b]].insert(tet);
      direction[nodes[a] + nodes[b]] = nodes[b] - nodes[a];
    }
  }
  int longEdges = 0, shortEdges = 0;
  for (const auto& [q, expected] : around) {
    if (std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) > 6) continue;  // its star may be cut off
    const bool isLong = squaredLength(direction[q]) == 4;
    ++(isLong ? longEdges : shortEdges);
    const EdgeStar star = tetsAroundEdge(q);
    EXPECT_EQ(star.count, isLong ? 4 : 6);
    const TetSet found(star.begin(), star.end());
    EXPECT_EQ(static_cast<int>(found.size()), star.count);
    EXPECT_TRUE(std::ranges::equal(found, expected)) << q.x << ' ' << q.y << ' ' << q.z;
  }
  EXPECT_GT(longEdges, 6 * 8);   // both parities, all axes, several places
  EXPECT_GT(shortEdges, 8 * 8);  // all eight diagonals
}

}  // namespace
}  // namespace sinew
