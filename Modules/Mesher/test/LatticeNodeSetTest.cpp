#include "LatticeOracle.h"
#include "sinew/Mesher/LatticeNodeSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>

namespace sinew {
namespace {

using test::Int3Less;

constexpr Int3 kPagedCells{19, 8, 13};  // pages of 8 cubes: full ones and cut ones

/// Random nodes of both sublattices, with repeats.
std::vector<Int3> randomNodes(unsigned seed, int count) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<Int3> nodes;
  for (int k = 0; k < count; ++k) {
    const int odd = below(2);
    nodes.push_back(
        {2 * below(kPagedCells.x) + odd, 2 * below(kPagedCells.y) + odd, 2 * below(kPagedCells.z) + odd});
  }
  return nodes;
}

TEST(LatticeNodeSet, AgreesWithAStandardSet) {
  constexpr unsigned seed = 11;
  LatticeNodeSet nodes(kPagedCells);
  std::set<Int3, Int3Less> oracle;
  for (const Int3 p : randomNodes(seed, 1500)) EXPECT_EQ(nodes.insert(p), oracle.insert(p).second);
  nodes.rank();
  EXPECT_EQ(nodes.size(), static_cast<std::int32_t>(oracle.size()));
  EXPECT_LT(oracle.size(), 1500u);  // there were repeats

  std::int64_t held = 0;
  for (int z = 0; z < 2 * kPagedCells.z; ++z)
    for (int y = 0; y < 2 * kPagedCells.y; ++y)
      for (int x = 0; x < 2 * kPagedCells.x; ++x) {
        if ((x & 1) != (y & 1) || (x & 1) != (z & 1)) continue;
        EXPECT_EQ(nodes.contains({x, y, z}), oracle.contains({x, y, z})) << x << ' ' << y << ' ' << z;
        held += nodes.contains({x, y, z});
      }
  EXPECT_EQ(held, nodes.size());
}

TEST(LatticeNodeSet, RankNumbersTheNodesInTheOrderOfTheList) {
  LatticeNodeSet nodes(kPagedCells);
  for (const Int3 p : randomNodes(12, 1500)) nodes.insert(p);
  nodes.rank();
  const std::vector<Int3> list = nodes.nodes();
  ASSERT_EQ(static_cast<std::int32_t>(list.size()), nodes.size());
  for (std::size_t n = 0; n < list.size(); ++n) {
    EXPECT_TRUE(nodes.contains(list[n]));
    EXPECT_EQ(nodes.indexOf(list[n]), static_cast<std::int32_t>(n));
  }
}

TEST(LatticeNodeSet, DoesNotDependOnTheOrderOfInsertion) {
  std::vector<Int3> points = randomNodes(13, 800);
  LatticeNodeSet first(kPagedCells);
  for (const Int3 p : points) first.insert(p);
  std::shuffle(points.begin(), points.end(), std::mt19937(14));
  LatticeNodeSet second(kPagedCells);
  for (const Int3 p : points) second.insert(p);
  first.rank();
  second.rank();
  EXPECT_EQ(first.nodes(), second.nodes());
  for (const Int3 p : points) EXPECT_EQ(first.indexOf(p), second.indexOf(p));
}

TEST(LatticeNodeSet, IsRankedAgainAfterMoreNodes) {
  const std::vector<Int3> points = randomNodes(15, 600);
  LatticeNodeSet all(kPagedCells), grown(kPagedCells);
  for (std::size_t n = 0; n < points.size(); ++n) {
    all.insert(points[n]);
    grown.insert(points[n]);
    if (n == 300) grown.rank();
  }
  all.rank();
  grown.rank();
  EXPECT_EQ(grown.size(), all.size());
  EXPECT_EQ(grown.nodes(), all.nodes());
}

TEST(LatticeNodeSet, OfNothingIsEmpty) {
  LatticeNodeSet nodes(kPagedCells);
  nodes.rank();
  EXPECT_EQ(nodes.size(), 0);
  EXPECT_TRUE(nodes.nodes().empty());
  EXPECT_FALSE(nodes.contains({0, 0, 0}));
}

TEST(LatticeNodeSet, TakesTheWholeBoxAndNothingOutside) {
  LatticeNodeSet nodes(kPagedCells);
  EXPECT_TRUE(nodes.insert({0, 0, 0}));
  EXPECT_TRUE(nodes.insert({2 * kPagedCells.x - 1, 2 * kPagedCells.y - 1, 2 * kPagedCells.z - 1}));
  for (int axis = 0; axis < 3; ++axis) {
    Int3 below, above;
    below[axis] = -2;
    above[axis] = 2 * kPagedCells[axis];
    EXPECT_THROW(nodes.insert(below), std::logic_error) << axis;
    EXPECT_THROW(nodes.insert(above), std::logic_error) << axis;
  }
  nodes.rank();
  EXPECT_EQ(nodes.size(), 2);
}

}  // namespace
}  // namespace sinew
