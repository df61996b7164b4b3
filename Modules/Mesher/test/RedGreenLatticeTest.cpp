#include "LatticeOracle.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Mesher/RedGreenLattice.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::allLeaves;
using test::LatticeFace;
using test::sixVolume;

constexpr Int3 kCells{8, 8, 8};
constexpr int kLevels = 4;

/// Random tets to refine, in the middle cubes so that the border stays whole.
std::vector<LevelTet> randomRequests(unsigned seed, int count, int levels = kLevels) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<LevelTet> requests;
  for (int k = 0; k < count; ++k) {
    LevelTet request{0, RedGreenLattice::coarseTets({3 + below(2), 3 + below(2), 3 + below(2)})[below(12)]};
    for (const int depth = below(levels - 1); request.level < depth; ++request.level)
      request.tet = redChildren(request.tet)[below(kRedChildren)];
    requests.push_back(request);
  }
  return requests;
}

RedGreenLattice refined(const std::vector<LevelTet>& requests) {
  RedGreenLattice lattice(kCells, kLevels);
  for (const LevelTet& request : requests) lattice.refine(request.level, request.tet);
  lattice.close();
  return lattice;
}

std::set<LatticeFace> outerFaces(const std::vector<LatticeTet>& leaves) {
  std::map<LatticeFace, int> tetsAtFace;
  for (const LatticeTet& leaf : leaves) test::countFaces(leaf.nodes, tetsAtFace);
  std::set<LatticeFace> outer;
  for (const auto& [face, count] : tetsAtFace) {
    EXPECT_LE(count, 2);
    if (count == 1) outer.insert(face);
  }
  return outer;
}

std::int64_t totalSixVolume(const std::vector<LatticeTet>& leaves) {
  std::int64_t sum = 0;
  for (const LatticeTet& leaf : leaves) sum += sixVolume(leaf.nodes);
  return sum;
}

constexpr unsigned kRefinements[] = {1, 2, 3, 4, 5, 6};

TEST(RedGreenLattice, WithoutRefinementHasTwelveTetsPerCube) {
  const RedGreenLattice lattice = refined({});
  const std::vector<LatticeTet> leaves = allLeaves(lattice);
  EXPECT_EQ(leaves.size(), 12u * 6 * 6 * 6);
  const std::int64_t cube = 2 << (kLevels - 1);  // in finest half cubes
  EXPECT_EQ(totalSixVolume(leaves), 6 * 6 * 6 * 6 * cube * cube * cube);
  EXPECT_TRUE(std::ranges::all_of(leaves, [](const LatticeTet& t) { return t.level == 0 && !t.green; }));
  EXPECT_EQ(lattice.nodes().size(), 9 * 9 * 9 + 8 * 8 * 8);
}

TEST(RedGreenLattice, LeavesConformAndKeepTheVolume) {
  const std::vector<LatticeTet> whole = allLeaves(refined({}));
  const std::set<LatticeFace> border = outerFaces(whole);
  for (const unsigned seed : kRefinements) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<LatticeTet> leaves = allLeaves(refined(randomRequests(seed, 8)));
    EXPECT_GT(leaves.size(), whole.size() + 100);
    EXPECT_EQ(totalSixVolume(leaves), totalSixVolume(whole));  // exact: integers
    EXPECT_EQ(outerFaces(leaves), border);  // a hanging node would leave faces with one tet inside
  }
}

TEST(RedGreenLattice, LeavesKeepTheExactBoundsOfTheTables) {
  constexpr double rounding = 1e-9;
  for (const unsigned seed : kRefinements) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    int green = 0;
    for (const LatticeTet& leaf : allLeaves(refined(randomRequests(seed, 8)))) {
      std::array<Vector3d, 4> x;
      for (int v = 0; v < 4; ++v) x[v] = Vector3d(leaf.nodes[v].x, leaf.nodes[v].y, leaf.nodes[v].z);
      const TetQuality q = tetQuality(x[0], x[1], x[2], x[3]);
      ASSERT_GT(q.volume, 0);
      ASSERT_LE(q.aspectRatio, (leaf.green ? std::sqrt(10.0) : std::sqrt(2.0)) + rounding);
      ASSERT_GE(q.minDihedralDeg, (leaf.green ? 30 : 60) - rounding);
      ASSERT_LE(q.maxDihedralDeg, (leaf.green ? 116.5650511770781 : 90) + rounding);
      green += leaf.green;
    }
    EXPECT_GT(green, 0);
  }
}

/// Whether a would-be descendant of a tet has a bisected edge inside the tet or on its border.
bool hasFinerNodes(const RedGreenLattice& lattice, int level, const BccTet& tet) {
  if (level + 1 >= lattice.levels()) return false;
  return std::ranges::any_of(redChildren(tet), [&](const BccTet& child) {
    return (level + 2 < lattice.levels() && lattice.bisectedEdges(level + 1, child) != 0) ||
           hasFinerNodes(lattice, level + 1, child);
  });
}

int countGreenAncestors(const RedGreenLattice& lattice, int level, const BccTet& tet) {
  if (level + 1 >= lattice.levels()) return 0;
  if (!lattice.isRefined(level, tet)) return hasFinerNodes(lattice, level, tet);
  int count = 0;
  for (const BccTet& child : redChildren(tet)) count += countGreenAncestors(lattice, level + 1, child);
  return count;
}

TEST(RedGreenLattice, NothingIsRefinedBelowAGreenTet) {
  for (const unsigned seed : kRefinements) {
    const RedGreenLattice lattice = refined(randomRequests(seed, 8));
    int offenders = 0;
    for (const BccTet& tet : test::coarseTetsOf(kCells)) offenders += countGreenAncestors(lattice, 0, tet);
    EXPECT_EQ(offenders, 0) << "seed " << seed;
  }
}

TEST(RedGreenLattice, RequestedTetsAndTheirAncestorsAreRefined) {
  for (const unsigned seed : kRefinements) {
    const std::vector<LevelTet> requests = randomRequests(seed, 8);
    const RedGreenLattice lattice = refined(requests);
    for (auto [level, tet] : requests)
      for (; level >= 0; --level, tet = redParent(tet)) EXPECT_TRUE(lattice.isRefined(level, tet));
  }
}

TEST(RedGreenLattice, ClosingTwiceChangesNothing) {
  for (const unsigned seed : kRefinements) {
    RedGreenLattice lattice = refined(randomRequests(seed, 8));
    const std::vector<Int3> once = lattice.nodes().nodes();
    lattice.close();
    EXPECT_EQ(lattice.nodes().nodes(), once) << "seed " << seed;
  }
}

TEST(RedGreenLattice, TheOrderOfRequestsAndClosingsDoesNotMatter) {
  for (const unsigned seed : kRefinements) {
    std::vector<LevelTet> requests = randomRequests(seed, 10);
    const std::vector<Int3> together = refined(requests).nodes().nodes();
    std::shuffle(requests.begin(), requests.end(), std::mt19937(seed));
    RedGreenLattice lattice(kCells, kLevels);
    for (const LevelTet& request : requests) {
      lattice.refine(request.level, request.tet);
      lattice.close();
    }
    EXPECT_EQ(lattice.nodes().nodes(), together) << "seed " << seed;
  }
}

TEST(RedGreenLattice, ManyAtOnceAsOneByOneForAnyNumberOfThreads) {
  constexpr int levels = 6;  // pages without a node of level 0
  for (const unsigned seed : kRefinements) {
    const std::vector<LevelTet> requests = randomRequests(seed, 2000, levels);
    RedGreenLattice single(kCells, levels);
    for (const LevelTet& request : requests) single.refine(request.level, request.tet);
    single.close();
    for (const std::size_t threads : {1, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      RedGreenLattice lattice(kCells, levels);
      lattice.refine(requests);
      lattice.close();
      EXPECT_EQ(lattice.nodes().nodes(), single.nodes().nodes()) << "seed " << seed << ", " << threads;
    }
  }
}

TEST(RedGreenLattice, ForEachLeafDescendsOnlyWhereItMayEnter) {
  const RedGreenLattice lattice = refined(randomRequests(7, 8));
  std::size_t emitted = 0;
  int deepest = 0;
  const auto enter = [&](int level, const std::array<Int3, 4>& nodes) {
    deepest = std::max(deepest, level);
    return level == 0 && nodes[0].x < 64;
  };
  for (const BccTet& tet : test::coarseTetsOf(kCells))
    lattice.forEachLeaf(0, tet, enter, [&](const LatticeTet& leaf) {
      ++emitted;
      EXPECT_EQ(leaf.level, 0);
    });
  EXPECT_EQ(deepest, 1);
  EXPECT_GT(emitted, 0u);
}

void refineWhole(RedGreenLattice& lattice, int level, const BccTet& tet, int depth) {
  lattice.refine(level, tet);
  if (level == depth) return;
  for (const BccTet& child : redChildren(tet)) refineWhole(lattice, level + 1, child, depth);
}

TEST(RedGreenLattice, RefinementThatReachesTheBorderIsRefused) {
  const auto refineCell = [](Int3 cell, int depth) {
    RedGreenLattice lattice(kCells, kLevels);
    for (const BccTet& tet : RedGreenLattice::coarseTets(cell)) refineWhole(lattice, 0, tet, depth);
    lattice.close();
  };
  for (int axis = 0; axis < 3; ++axis) {
    Int3 first{4, 4, 4}, last = first, outermost = first;
    first[axis] = 1;
    last[axis] = kCells[axis] - 2;
    outermost[axis] = 0;
    EXPECT_THROW(refineCell(first, 0), std::logic_error) << axis;  // its tets reach into cube 0
    EXPECT_THROW(refineCell(last, 2), std::logic_error) << axis;   // and the grading into cube n - 1
    EXPECT_THROW(refineCell(outermost, 0), std::logic_error) << axis;
  }
  EXPECT_NO_THROW(refineCell({4, 4, 4}, 2));
}

}  // namespace
}  // namespace sinew
