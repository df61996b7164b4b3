#include "Background.h"
#include "LatticeOracle.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace sinew {
namespace {

using Eigen::Vector3d;

using Built = test::Background;

Built built(const SignedDistance& phi, double edgeLength) { return test::backgroundOf(phi, edgeLength, 4); }

/// Every leaf of the block with the numbers of the whole lattice.
std::vector<Tet> numberedLeaves(const RedGreenLattice& lattice) {
  std::vector<Tet> tets;
  for (const LatticeTet& leaf : test::allLeaves(lattice)) {
    Tet tet;
    for (int v = 0; v < 4; ++v) tet[v] = lattice.nodes().indexOf(leaf.nodes[v]);
    tets.push_back(tet);
  }
  return tets;
}

/// Lattice node of every mesh node: the mesh keeps the order of the lattice.
std::vector<std::int32_t> latticeNumbers(const Built& b) {
  std::vector<std::int32_t> numbers;
  const std::vector<Int3> nodes = b.lattice.nodes().nodes();
  std::size_t n = 0;
  for (const Vector3d& x : b.mesh.positions) {
    while (n < nodes.size() && b.plan.frame.position(nodes[n]) != x) ++n;
    numbers.push_back(static_cast<std::int32_t>(n++));
  }
  EXPECT_LE(n, nodes.size());
  return numbers;
}

constexpr unsigned kSeeds[] = {0, 1, 3, 5};

TEST(NodeStars, ListTheTetsOfEveryNodeInOrder) {
  const std::vector<Tet> tets{{0, 1, 2, 3}, {3, 2, 1, 5}, {5, 1, 0, 3}};
  const NodeStars stars = nodeStars(6, tets);
  ASSERT_EQ(stars.offsets.size(), 7u);
  for (std::int32_t n = 0; n < 6; ++n) {
    std::vector<std::int32_t> expected;
    for (std::int32_t t = 0; t < 3; ++t)
      if (std::ranges::count(tets[t], n) > 0) expected.push_back(t);
    EXPECT_TRUE(std::ranges::equal(stars.of(n), expected)) << n;
  }
}

TEST(NodeStars, OfManyTetsAreTheSame) {
  constexpr std::size_t nodes = 700;
  std::mt19937 random(21);
  std::vector<Tet> tets(100'000);  // enough for several tasks
  std::vector<std::vector<std::int32_t>> expected(nodes);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (std::int32_t& v : tets[t]) {
      v = static_cast<std::int32_t>(random() % nodes);
      expected[v].push_back(static_cast<std::int32_t>(t));
    }
  }
  const NodeStars stars = nodeStars(nodes, tets);
  for (std::size_t n = 0; n < nodes; ++n)
    ASSERT_TRUE(std::ranges::equal(stars.of(static_cast<std::int32_t>(n)), expected[n])) << "seed 21, " << n;
}

TEST(LatticeMesh, HoldsPhiAtItsNodesAndPositiveTets) {
  const test::AnalyticTorus torus({1, 2, 3}, 6, 2);
  const Built b = built(torus, 1);
  ASSERT_EQ(b.mesh.phi.size(), b.mesh.positions.size());
  for (std::size_t n = 0; n < b.mesh.phi.size(); ++n)
    ASSERT_EQ(b.mesh.phi[n], torus.value(b.mesh.positions[n]));
  const auto& x = b.mesh.positions;
  for (const Tet& t : b.mesh.tets) {
    ASSERT_GT((x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]), 0);
  }
  std::vector<int> used(x.size());
  for (const Tet& t : b.mesh.tets)
    for (const std::int32_t v : t) used[v] = 1;
  EXPECT_EQ(std::ranges::count(used, 0), 0);
}

TEST(LatticeMesh, KeepsTheLeavesNearOrInsideTheShapeAndTheirOrder) {
  for (const unsigned seed : kSeeds) {
    const test::RandomShape shape = test::randomShape(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + shape.name());
    const Built b = built(shape, 1);
    const std::vector<std::int32_t> numbers = latticeNumbers(b);
    ASSERT_TRUE(std::ranges::is_sorted(numbers));
    std::set<Tet> kept;
    for (Tet tet : b.mesh.tets) {
      for (std::int32_t& v : tet) v = numbers[v];
      kept.insert(tet);
    }
    EXPECT_EQ(kept.size(), b.mesh.tets.size());

    const std::vector<Int3> nodes = b.lattice.nodes().nodes();
    std::size_t found = 0;
    for (const Tet& tet : numberedLeaves(b.lattice)) {
      double lowest = 1e300, longest = 0;
      for (const std::int32_t v : tet)
        lowest = std::min(lowest, shape.value(b.plan.frame.position(nodes[v])));
      for (const auto& [i, j] : kTetEdges) {
        const Int3 edge = nodes[tet[i]] - nodes[tet[j]];
        longest =
            std::max(longest, b.plan.frame.halfCube * std::sqrt(static_cast<double>(test::dot(edge, edge))));
      }
      found += kept.contains(tet);
      if (lowest < 2 * longest - 1e-9) {
        EXPECT_TRUE(kept.contains(tet));
      }
      // The rule goes by the cube: a green child has an edge of 0.7 of it or more.
      if (lowest > 3 * longest) {
        EXPECT_FALSE(kept.contains(tet));
      }
    }
    EXPECT_EQ(found, kept.size());  // nothing else
  }
}

TEST(LatticeMesh, StarsNearTheSurfaceAreComplete) {
  for (const unsigned seed : kSeeds) {
    const test::RandomShape shape = test::randomShape(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + shape.name());
    const Built b = built(shape, 1);
    const std::vector<std::int32_t> numbers = latticeNumbers(b);
    const std::vector<Tet> leaves = numberedLeaves(b.lattice);
    const NodeStars whole = nodeStars(b.lattice.nodes().size(), leaves);
    const NodeStars stars = nodeStars(b.mesh.positions.size(), b.mesh.tets);
    const std::vector<Int3> nodes = b.lattice.nodes().nodes();
    int complete = 0;
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      const auto star = whole.of(numbers[n]);
      double shortest = 1e300;
      for (const std::int32_t t : star)
        for (const std::int32_t v : leaves[t]) {
          const Int3 edge = nodes[v] - nodes[numbers[n]];
          if (edge == Int3{}) continue;
          shortest = std::min(shortest,
                              b.plan.frame.halfCube * std::sqrt(static_cast<double>(test::dot(edge, edge))));
        }
      if (b.mesh.phi[n] >= 2 * shortest) continue;
      ++complete;
      ASSERT_EQ(stars.of(static_cast<std::int32_t>(n)).size(), star.size());
    }
    EXPECT_GT(complete, 100);
  }
}

TEST(LatticeMesh, TheSameForAnyNumberOfThreads) {
  const test::RandomShape shape = test::randomShape(4);
  const auto withThreads = [&](std::size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return built(shape, 0.7).mesh;
  };
  const LatticeMesh one = withThreads(1), four = withThreads(4);
  EXPECT_EQ(one.tets, four.tets);
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.phi, four.phi);
}

}  // namespace
}  // namespace sinew
