#include "GoalMeasure.h"
#include "sinew/Mesher/MeshQuality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

// The interval of the cosines, derived again from its two angles.
const double kCosMin = std::cos(130 * std::numbers::pi / 180), kCosMax = std::sqrt(3.0) / 2;
const double kCentre = (kCosMin + kCosMax) / 2, kRadius = (kCosMax - kCosMin) / 2;

double byQuality(const TetQuality& q) {
  const auto miss = [](double degrees) {
    return std::abs(std::cos(degrees * std::numbers::pi / 180) - kCentre) / kRadius;
  };
  return std::max({q.aspectRatio / kGoalAspectRatio, miss(q.minDihedralDeg), miss(q.maxDihedralDeg)});
}

TEST(GoalMeasure, OfTheRegularTetIsItsAspectRatio) {
  EXPECT_NEAR(goalMeasure({-1, -1, 1}, {1, 1, 1}, {-1, 1, -1}, {1, -1, -1}), std::sqrt(1.5) / 3, 1e-14);
}

TEST(GoalMeasure, OfABccTetIsThatOfItsSixtyDegrees) {
  const double expected = (0.5 - kCentre) / kRadius;
  EXPECT_NEAR(goalMeasure({.5, -.5, .5}, {0, 0, 0}, {1, 0, 0}, {.5, .5, .5}), expected, 1e-14);
  EXPECT_GT(expected, std::sqrt(2.0) / 3);
}

TEST(GoalMeasure, AgreesWithTheQualityOfRandomTets) {
  std::mt19937 random(41);
  const auto point = [&] {
    const auto coordinate = [&] { return double(random()) / 4294967296.0; };
    const double x = coordinate(), y = coordinate();
    return Vector3d(x, y, coordinate());
  };
  int good = 0, byRatio = 0, byAngle = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vector3d x = point(), a = point();
    Vector3d b = point(), c = point();
    if (tetQuality(a, b, c, x).volume < 0) std::swap(b, c);
    const TetQuality q = tetQuality(a, b, c, x);
    if (q.aspectRatio > 100) continue;  // mostly rounding
    const double m = goalMeasure(x, a, b, c);
    ASSERT_NEAR(m, byQuality(q), 1e-9 * m) << "seed 41, tet " << k;
    ASSERT_NEAR(goalMeasure(a, x, c, b), m, 1e-9 * m);
    ASSERT_EQ(goalMeasure(x, a, c, b), kInfinity);  // inverted
    const bool inGoals = q.aspectRatio <= 3 && q.minDihedralDeg >= 30 && q.maxDihedralDeg <= 130;
    ASSERT_EQ(m <= 1, inGoals);
    good += inGoals;
    ++(m == q.aspectRatio / 3 || std::abs(m - q.aspectRatio / 3) < 1e-9 ? byRatio : byAngle);
  }
  EXPECT_GT(good, 20);
  EXPECT_GT(byRatio, 100);
  EXPECT_GT(byAngle, 20);
}

TEST(GoalMeasure, IsInfiniteForAFlatTet) {
  EXPECT_EQ(goalMeasure({.2, .2, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), kInfinity);
}

}  // namespace
}  // namespace sinew
