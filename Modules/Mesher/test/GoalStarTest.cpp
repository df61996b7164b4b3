#include "GoalMeasure.h"
#include "GoalStar.h"

#include <gtest/gtest.h>

#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr double kStarRounding =
    1e-12;  // relative; fused multiply-adds may be in one of the two and not the other

/// Random tets around a node: many of them inverted, some flat.
struct RandomStar {
  std::vector<Vector3d> nodes;
  std::vector<StarFaceNodes> faces;
  GoalStar star;

  explicit RandomStar(unsigned seed, int tets = 27) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int n = 0; n < 3 * tets; ++n)
      nodes.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    for (int t = 0; t < tets; ++t) faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    star.gather(faces, nodes);
  }
  double measure(const Vector3d& x, std::size_t t) const {
    return goalMeasure(x, nodes[faces[t][0]], nodes[faces[t][1]], nodes[faces[t][2]]);
  }
};

void expectNear(double value, double expected) {
  if (std::isinf(expected)) {
    EXPECT_EQ(value, expected);
  } else {
    EXPECT_NEAR(value, expected, kStarRounding * expected);
  }
}

TEST(GoalStar, MeasuresAgreeWithThoseOfSingleTets) {
  int positive = 0, inverted = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStar s(seed);
    const Vector3d x(0.1, -0.2, 0.05);
    const std::span<const double> measures = s.star.measures(x, s.star.size());
    for (std::size_t t = 0; t < s.faces.size(); ++t) {
      expectNear(measures[t], s.measure(x, t));
      ++(std::isinf(measures[t]) ? inverted : positive);
    }
  }
  EXPECT_GT(positive, 100);
  EXPECT_GT(inverted, 100);
}

TEST(GoalStar, AFlatTetIsInfinite) {
  GoalStar star;
  star.gather(std::vector<StarFaceNodes>{{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(star.measures({.2, .2, 0}, 1)[0], kInfinity);
  EXPECT_LT(star.measures({.2, .2, .5}, 1)[0], kInfinity);
}

TEST(GoalStar, EnergySumsThePowersOfTheFirstTets) {
  // Nodes of the regular tet, turned: all tets positive.
  const std::vector<Vector3d> nodes{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {1.2, .9, 1.1}, {-1, 1.3, -1}};
  const std::vector<StarFaceNodes> faces{{0, 1, 2}, {3, 1, 2}, {0, 4, 2}};
  const Vector3d x(-1, -1, 1);
  GoalStar star;
  star.gather(faces, nodes);
  for (const int q : {1, 2, 16, 64}) {
    double sum = 0;
    for (std::size_t count = 1; count <= faces.size(); ++count) {
      const auto& [a, b, c] = faces[count - 1];
      sum += power(goalMeasure(x, nodes[a], nodes[b], nodes[c]), q);
      ASSERT_LT(sum, kInfinity);
      EXPECT_NEAR(star.energy(x, q, count), sum, q * kStarRounding * sum);
    }
  }
}

TEST(GoalStar, SwapExchangesTetsAndTheShortestEdgeStays) {
  RandomStar s(5);
  const Vector3d x(0.3, 0.1, 0);
  double shortest = kInfinity;
  for (const Vector3d& node : s.nodes) shortest = std::min(shortest, (node - x).norm());
  EXPECT_NEAR(s.star.shortestEdge(x), shortest, kStarRounding);
  s.star.swap(0, 4);
  EXPECT_NEAR(s.star.shortestEdge(x), shortest, kStarRounding);
  const std::span<const double> measures = s.star.measures(x, s.star.size());
  expectNear(measures[0], s.measure(x, 4));
  expectNear(measures[4], s.measure(x, 0));
  expectNear(measures[1], s.measure(x, 1));
}

TEST(GoalStar, IsGatheredAgainWithFewerAndMoreTets) {
  RandomStar few(6, 5), many(7, 40);
  GoalStar star;
  const Vector3d x(0, 0.2, 0.1);
  for (const RandomStar* s : {&few, &many, &few}) {
    star.gather(s->faces, s->nodes);
    ASSERT_EQ(star.size(), s->faces.size());
    const std::span<const double> measures = star.measures(x, star.size());
    for (std::size_t t = 0; t < star.size(); ++t) expectNear(measures[t], s->measure(x, t));
  }
}

}  // namespace
}  // namespace sinew
