#include "Sampling.h"
#include "sinew/LevelSet/FastMarching.h"
#include "sinew/LevelSet/FieldVolume.h"
#include "sinew/LevelSet/MeanCurvatureMotion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::sampled;

constexpr double kMotionBand = 4;
using std::numbers::pi;

TEST(MeanCurvatureMotion, ABallShrinksAsItMust) {
  const double h = 0.7;
  const double cases[][2] = {
      {6, 0.5}, {10, 0.75}, {16, 0.6}};  // radius in samples, part of the time to nothing
  for (const auto& [samples, part] : cases) {
    const double radius = samples * h, time = part * radius * radius / 4;
    const Vector3i size = Vector3i::Constant(static_cast<int>(2 * samples) + 12);
    DenseField phi = sampled(size, Vector3d::Constant(-radius - 5.3 * h), Vector3d::Constant(h),
                             [&](const Vector3d& x) { return x.norm() - radius; });
    meanCurvatureMotion(phi, h, time, kMotionBand * h);
    const double shrunk = std::cbrt(fieldVolume(phi, Vector3d::Constant(h)) * 3 / (4 * pi));
    EXPECT_NEAR(shrunk / std::sqrt(radius * radius - 4 * time), 1, 0.005)
        << samples << ", " << time << " mm^2";
  }
}

TEST(MeanCurvatureMotion, ACylinderShrinksAsItMust) {
  for (const double radius : {6.0, 12.0}) {
    for (const double part : {0.25, 0.5}) {
      const double time = part * radius * radius / 2;
      const int n = static_cast<int>(2 * radius) + 12;
      DenseField phi = sampled({5, n, n}, {0, -radius - 5.3, -radius - 5.8}, Vector3d::Ones(),
                               [&](const Vector3d& x) { return x.tail<2>().norm() - radius; });
      meanCurvatureMotion(phi, 1, time, kMotionBand);
      const double shrunk = std::sqrt(fieldVolume(phi, Vector3d::Ones()) / 5 / pi);
      EXPECT_NEAR(shrunk / std::sqrt(radius * radius - 2 * time), 1, 0.005)
          << radius << " mm, " << time << " mm^2";
    }
  }
}

TEST(MeanCurvatureMotion, TheStairsOfATiltedPlaneFlatten) {
  const Vector3d normal = Vector3d(0.17, 0.1, 1).normalized(), origin(-24, -24, -15.3);
  DenseField phi = sampled({48, 48, 30}, origin, Vector3d::Ones(),
                           [&](const Vector3d& x) { return x.dot(normal) < 0 ? -0.5 : 0.5; });
  fastMarching(phi, Vector3d::Ones(), kMotionBand);
  /// The largest distance of the surface from the plane, voxels, away from the border.
  const auto amplitude = [&] {
    double worst = 0;
    for (int k = 5; k < 25; ++k)
      for (int j = 10; j < 38; ++j)
        for (int i = 10; i < 38; ++i)
          if (std::abs(phi(i, j, k)) < 0.5)
            worst = std::max(worst, std::abs(phi(i, j, k) - (origin + Vector3d(i, j, k)).dot(normal)));
    return worst;
  };
  EXPECT_GT(amplitude(), 0.4);
  meanCurvatureMotion(phi, 1, 1.5, kMotionBand);
  EXPECT_LT(amplitude(), 0.1);
}

TEST(MeanCurvatureMotion, APlaneAndAPlateStay) {
  const Vector3d normal = Vector3d(0.3, 0.2, 1).normalized(), origin(-20, -20, -20.3);
  const auto plane = [&](const Vector3d& x) { return x.dot(normal); };
  const auto plate = [&](const Vector3d& x) { return std::abs(x.dot(normal)) - 2; };
  for (const bool thin : {false, true}) {
    const auto exact = [&](const Vector3d& x) { return thin ? plate(x) : plane(x); };
    DenseField phi = sampled(Vector3i::Constant(41), origin, Vector3d::Ones(), exact);
    meanCurvatureMotion(phi, 1, 2, kMotionBand);
    double worst = 0;
    for (int k = 10; k < 31; ++k)
      for (int j = 10; j < 31; ++j)
        for (int i = 10; i < 31; ++i) {
          const double d = exact(origin + Vector3d(i, j, k));
          if (std::abs(d) < 0.6) worst = std::max(worst, std::abs(phi(i, j, k) - d));
        }
    // The central differences of a plate of four samples just reach its skeleton.
    EXPECT_LT(worst, thin ? 0.05 : 0.003);
  }
}

TEST(MeanCurvatureMotion, WhatShrinksAwayIsGone) {
  DenseField phi = sampled({40, 20, 20}, {-10, -10, -10}, Vector3d::Ones(), [](const Vector3d& x) {
    return std::min(x.norm() - 6, (x - Vector3d(18, 0, 0)).norm() - 2.2);
  });
  meanCurvatureMotion(phi, 1, 2, kMotionBand);  // the small ball's time is 2.2^2/4 = 1.2
  for (int i = 25; i < 40; ++i) EXPECT_GT(phi(i, 10, 10), 0);
  EXPECT_LT(phi(10, 10, 10), 0);
  meanCurvatureMotion(phi, 1, 10, kMotionBand);  // the large one's is 9
  for (const float v : phi.values) ASSERT_EQ(v, float{kMotionBand});
}

TEST(MeanCurvatureMotion, NoiseAndFlatFieldsStayBounded) {
  for (const double height : {0.0, 1.0}) {
    DenseField phi = sampled({20, 20, 20}, Vector3d::Zero(), Vector3d::Ones(), [&](const Vector3d& x) {
      return height * std::round(4 * std::sin(17 * x.x() + 5 * x.y() * x.z()));
    });
    meanCurvatureMotion(phi, 1, 1, kMotionBand);
    for (const float v : phi.values) ASSERT_LE(std::abs(v), kMotionBand);
  }
}

TEST(MeanCurvatureMotion, ThePartBeyondANarrowBandDoesNotMatter) {
  const auto ball = [](double limit) {
    return sampled(Vector3i::Constant(32), Vector3d::Constant(-15.7), Vector3d::Ones(),
                   [&](const Vector3d& x) { return std::clamp(x.norm() - 10, -limit, limit); });
  };
  DenseField wide = ball(1e9), narrow = ball(2.5);
  meanCurvatureMotion(wide, 1, 6, kMotionBand);
  meanCurvatureMotion(narrow, 1, 6, kMotionBand);
  EXPECT_NEAR(fieldVolume(narrow, Vector3d::Ones()) / fieldVolume(wide, Vector3d::Ones()), 1, 1e-3);
}

TEST(MeanCurvatureMotion, NoTimeChangesNothing) {
  DenseField phi = sampled({9, 9, 9}, Vector3d::Constant(-4), Vector3d::Ones(),
                           [](const Vector3d& x) { return x.norm() - 3; });
  const DenseField before = phi;
  EXPECT_EQ(meanCurvatureMotion(phi, 1, 0, kMotionBand).steps, 0);
  EXPECT_EQ(phi.values, before.values);
}

TEST(MeanCurvatureMotion, TheNumberOfThreadsDoesNotShow) {
  const auto run = [] {
    DenseField phi = sampled(
        {40, 40, 40}, Vector3d::Constant(-19.7), Vector3d::Ones(),
        [](const Vector3d& x) { return std::max(x.cwiseAbs().maxCoeff() - 12, 8 - x.head<2>().norm()); });
    meanCurvatureMotion(phi, 1, 3, kMotionBand);
    return phi.values;
  };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(MeanCurvatureMotion, RefusesArgumentsOutOfRange) {
  DenseField phi({5, 5, 5}, 1.0F);
  EXPECT_THROW(meanCurvatureMotion(phi, 0, 1, kMotionBand), std::invalid_argument);
  EXPECT_THROW(meanCurvatureMotion(phi, 1, -1, kMotionBand), std::invalid_argument);
  EXPECT_THROW(meanCurvatureMotion(phi, 1, 1.1e4, kMotionBand), std::invalid_argument);
  EXPECT_THROW(meanCurvatureMotion(phi, 1, 1, 0), std::invalid_argument);
  EXPECT_THROW(meanCurvatureMotion(phi, 1, 1, kMotionBand, {.cfl = 0.2}), std::invalid_argument);
  EXPECT_THROW(meanCurvatureMotion(phi, 1, 1, kMotionBand, {.stepsPerRedistance = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
