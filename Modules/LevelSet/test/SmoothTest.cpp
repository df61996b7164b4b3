#include "Sampling.h"
#include "Shapes.h"
#include "sinew/LevelSet/Smooth.h"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::ball;
using test::block;
using test::levelSetOf;

TEST(Smooth, MovesABallByItsCurvature) {
  DenseLevelSet shape = levelSetOf(ball({0.3, 0, -0.2}, 12));
  const SmoothReport report = smooth(shape, {.time = 6, .preserve = Preserve::Nothing});
  const double radius = std::cbrt(shapeVolume(shape) * 3 / (4 * std::numbers::pi));
  EXPECT_NEAR(radius, std::sqrt(144 - 4 * 6), 0.005 * radius) << "METHOD [12]";
  EXPECT_EQ(report.offset, 0);
  EXPECT_EQ(report.volumeAfter, shapeVolume(shape));
}

TEST(Smooth, KeepsTheVolume) {
  const auto peanut = [](const Vector3d& x) {
    return std::min({ball({-6, 0, 0}, 7)(x), ball({7, 1, 0}, 6)(x), block({0, 0, 0}, {8, 3, 3})(x)});
  };
  for (const SmoothOptions& options : {SmoothOptions{.time = 4, .preserve = Preserve::Volume},
                                       SmoothOptions{.sigma = 2, .preserve = Preserve::Volume},
                                       SmoothOptions{.time = 4, .preserve = Preserve::Both}}) {
    DenseLevelSet shape = levelSetOf(peanut);
    const SmoothReport report = smooth(shape, options);
    EXPECT_NEAR(report.volumeAfter / report.volumeBefore, 1, 1e-3);
    EXPECT_EQ(report.volumeAfter, shapeVolume(shape));
    EXPECT_GT(report.offset, 0);
    EXPECT_EQ(report.before, report.after);
  }
}

/// A plate of three samples, a rod of two and a ball, in one.
DenseLevelSet thinParts() {
  return levelSetOf([](const Vector3d& x) {
    const double plate = block({0, 0, 0}, {16, 10, 1.5})(x);
    const double rod = std::max((x - Vector3d(0, 0, 12)).tail<2>().norm() - 1, std::abs(x.x()) - 16);
    return std::min({plate, rod, ball({-8, 0, 4}, 5)(x)});
  });
}

TEST(Smooth, ThinPartsSurviveWithTheirTopology) {
  DenseLevelSet lost = thinParts(), kept = lost;
  ASSERT_NE(smooth(lost, {.time = 3, .preserve = Preserve::Nothing}).after.components, 2)
      << "or nothing is shown";
  const SmoothReport report = smooth(kept, {.time = 3, .preserve = Preserve::Both});
  EXPECT_EQ(report.before, report.after);
  EXPECT_GT(report.heldSamples, 0);
  EXPECT_NEAR(report.volumeAfter / report.volumeBefore, 1, 1e-3);
}

TEST(Smooth, StrongSmoothingKeepsTheVolumeOfWhatStays) {
  for (const double radius : {4.0, 7.0})
    for (const SmoothOptions& options : {SmoothOptions{.time = 15, .preserve = Preserve::Volume},
                                         SmoothOptions{.time = 30, .preserve = Preserve::Both},
                                         SmoothOptions{.sigma = 2, .preserve = Preserve::Both}}) {
      DenseLevelSet shape = levelSetOf(ball({0.2, 0, 0}, radius), 12);
      const SmoothReport report = smooth(shape, options);
      EXPECT_NEAR(report.volumeAfter / report.volumeBefore, 1, 1e-3) << radius << ", " << options.time;
      EXPECT_EQ(report.after, (ShapeTopology{1, 0}));
    }
}

TEST(Smooth, AHollowStaysAHollow) {
  DenseLevelSet shape = levelSetOf([](const Vector3d& x) {
    return std::max(ball({0, 0, 0}, 14)(x), -ball({4, 0, 0}, 2)(x));
  });
  DenseLevelSet filled = shape;
  EXPECT_EQ(smooth(filled, {.time = 2, .preserve = Preserve::Volume}).after.cavities, 0);
  EXPECT_EQ(smooth(shape, {.time = 2, .preserve = Preserve::Both}).after, (ShapeTopology{1, 1}));
}

TEST(Smooth, MakesRoomAtTheBorder) {
  DenseLevelSet shape = trimmed(levelSetOf(block({0, 0, 0}, {9, 9, 9})));
  const SmoothReport report = smooth(shape, {.time = 8, .preserve = Preserve::Volume});
  EXPECT_NEAR(report.volumeAfter / report.volumeBefore, 1, 1e-3) << "faces bulge beyond the box of the cube";
  for (int j = 0; j < shape.phi.size.y(); ++j) EXPECT_GT(shape.phi(0, j, shape.phi.size.z() / 2), 0);
}

TEST(Smooth, RefusesNegativeOptions) {
  DenseLevelSet shape = levelSetOf(ball({0, 0, 0}, 5), 10);
  EXPECT_THROW(smooth(shape, {.time = -1}), std::invalid_argument);
  EXPECT_THROW(smooth(shape, {.sigma = -1}), std::invalid_argument);
  EXPECT_THROW(smooth(shape, {.sigma = 101}), std::invalid_argument);
}

TEST(Smooth, SameBitsForAnyNumberOfThreads) {
  const auto run = [] {
    DenseLevelSet shape = thinParts();
    smooth(shape, {.time = 2, .sigma = 0.5});
    return shape.phi.values;
  };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

}  // namespace
}  // namespace sinew
