#include "Sampling.h"
#include "sinew/LevelSet/SliceDistances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::sampled;

TEST(SliceDistances, ToACircleAreThoseOfItsPolygon) {
  const Vector3d spacing(0.5, 0.8, 1);
  const auto circle = [](const Vector3d& x) { return std::hypot(x.x(), x.y()) - 8; };
  const Vector3d origin(-14.8, -15.1, 0);
  DenseField d = sampled({60, 40, 2}, origin, spacing, [&](const Vector3d& x) { return 0.1 * circle(x); });
  sliceDistances(d, {0.5, 0.8}, 100);
  double worst = 0;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 60; ++i)
      worst =
          std::max(worst, std::abs(d(i, j, 1) - circle(origin + spacing.cwiseProduct(Vector3d(i, j, 1)))));
  // The chord of a pixel's diagonal has a sagitta of (0.94/2)^2 / (2 * 8) = 0.014 mm; the crossings are
  // linear, as much again; far away the nearest crossing is at most half a chord off: 0.014 mm at three
  // pixels.
  EXPECT_LT(worst, 0.055);
}

TEST(SliceDistances, ToAStraightLineAreExactNearIt) {
  const Vector3d normal = Vector3d(3, 4, 0) / 5;
  const auto line = [&](const Vector3d& x) { return x.dot(normal) - 0.3; };
  const Vector3d origin(-10, -10, 0);
  DenseField d = sampled({21, 21, 1}, origin, Vector3d::Ones(), line);
  sliceDistances(d, {1, 1}, 100);
  for (int j = 5; j < 16; ++j)
    for (int i = 5; i < 16; ++i) {
      const double exact = line(origin + Vector3d(i, j, 0));
      if (std::abs(exact) < 2) {
        EXPECT_NEAR(d(i, j, 0), exact, 1e-5) << "float";
      }
    }
}

TEST(SliceDistances, SlicesWithoutAContourAndFarPixelsHoldTheLimit) {
  DenseField d({5, 5, 2}, 1.0F);
  for (int n = 0; n < 25; ++n) d.values[static_cast<std::size_t>(n)] = -1;
  sliceDistances(d, {1, 1}, 7);
  EXPECT_EQ(d(2, 2, 0), -7.0F);
  EXPECT_EQ(d(2, 2, 1), 7.0F);
}

TEST(SliceDistances, NoPixelChangesSideInNoiseAndThreadsDoNotShow) {
  const DenseField noise = sampled({30, 30, 3}, Vector3d::Zero(), Vector3d::Ones(), [](const Vector3d& x) {
    return std::sin(13 * x.x() + 7 * x.y() * x.z() + x.y());
  });
  const auto run = [&] {
    DenseField d = noise;
    sliceDistances(d, {1, 1}, 10);
    return d.values;
  };
  const std::vector<float> one = test::onThreads(1, run);
  EXPECT_EQ(one, test::onThreads(4, run));
  for (std::size_t n = 0; n < one.size(); ++n) EXPECT_EQ(one[n] < 0, noise.values[n] < 0);
}

TEST(SliceDistances, RefusesPixelsAndLimitsThatAreNotPositive) {
  DenseField d({3, 3, 1});
  EXPECT_THROW(sliceDistances(d, {0, 1}, 1), std::invalid_argument);
  EXPECT_THROW(sliceDistances(d, {1, 1}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
