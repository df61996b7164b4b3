#include "SurfaceProjection.h"
#include "sinew/TestSupport/AnalyticDistance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr double kTolerance = 1e-6;

/// phi that depends on z alone.
class Layered : public SignedDistance {
 public:
  using Profile = std::function<std::pair<double, double>(double z)>;  ///< value and slope
  explicit Layered(Profile profile) : profile_(std::move(profile)) {}
  double value(const Vector3d& x) const override { return profile_(x.z()).first; }
  double valueAndGradient(const Vector3d& x, Vector3d& gradient) const override {
    const auto [value, slope] = profile_(x.z());
    gradient = slope * Vector3d::UnitZ();
    return value;
  }
  Eigen::AlignedBox3d bounds() const override { return {Vector3d::Constant(-1), Vector3d::Constant(1)}; }
  double resolution() const override { return 1; }
  double band() const override { return 10; }

 private:
  Profile profile_;
};

class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : random_(seed) {}
  Vector3d in(double halfWidth) {
    const double x = coordinate(), y = coordinate();
    return halfWidth * Vector3d(x, y, coordinate());
  }

 private:
  double coordinate() { return 2 * double(random_()) / 4294967296.0 - 1; }
  std::mt19937 random_;
};

TEST(SurfaceProjection, OntoASphereIsRadial) {
  const test::AnalyticSphere sphere({1, 2, 3}, 5);
  const SurfaceProjection project(sphere, kTolerance);
  RandomPoints points(51);
  for (int k = 0; k < 200; ++k) {
    const Vector3d offset = points.in(6);
    if (offset.norm() < 0.5) continue;
    for (const double level : {0.0, 0.7, -1.3}) {
      const auto found = project(Vector3d(1, 2, 3) + offset, level);
      ASSERT_TRUE(found);
      const Vector3d expected = Vector3d(1, 2, 3) + (5 + level) * offset.normalized();
      EXPECT_LE((*found - expected).norm(), kTolerance);
    }
  }
}

TEST(SurfaceProjection, LeavesAPointOfTheLevelWhereItIs) {
  const test::AnalyticSphere sphere(Vector3d::Zero(), 5);
  const Vector3d x(5 + kTolerance / 2, 0, 0);
  EXPECT_EQ(SurfaceProjection(sphere, kTolerance)(x, 0), x);
}

TEST(SurfaceProjection, LandsOnABoxFromEverySide) {
  const test::AnalyticBox box({-3, -2, -1}, {3, 2, 1});
  const SurfaceProjection project(box, kTolerance);
  RandomPoints points(52);
  for (int k = 0; k < 500; ++k) {
    const Vector3d x = points.in(4);
    const auto found = project(x, 0);
    ASSERT_TRUE(found) << x.transpose();
    EXPECT_LE(std::abs(box.value(*found)), kTolerance);
    // Distance and gradient are exact: the nearest point, edges and corners included.
    EXPECT_LE((*found - x).norm(), std::abs(box.value(x)) + kTolerance);
  }
}

TEST(SurfaceProjection, LandsInTheCreaseOfTwoSpheres) {
  const test::AnalyticUnion spheres({std::make_shared<test::AnalyticSphere>(Vector3d(-1.5, 0, 0), 2),
                                     std::make_shared<test::AnalyticSphere>(Vector3d(1.5, 0, 0), 2)});
  const SurfaceProjection project(spheres, kTolerance);
  RandomPoints points(53);
  int found = 0, tried = 0;
  for (int k = 0; k < 1000; ++k) {
    Vector3d x = points.in(2.5);
    x.x() *= 0.1;  // near the plane of the crease, where the gradient jumps
    if (std::abs(spheres.value(x)) > 0.8) continue;
    ++tried;
    const auto target = project(x, 0);
    if (!target) continue;
    ++found;
    EXPECT_LE(std::abs(spheres.value(*target)), kTolerance);
    EXPECT_LE((*target - x).norm(), 4 * std::abs(spheres.value(x)) + kTolerance);
  }
  EXPECT_GT(tried, 100);
  EXPECT_EQ(found, tried);
}

TEST(SurfaceProjection, SettlesWhereNewtonStepsCycle) {
  // Odd and monotone, steep at the surface: Newton's step from z = 1 leads to z = -1 and back.
  const Layered kinked([](double z) {
    const double a = std::abs(z);
    return a <= 0.25 ? std::pair(2.5 * z, 2.5) : std::pair(std::copysign(0.5 * a + 0.5, z), 0.5);
  });
  const SurfaceProjection project(kinked, kTolerance);
  for (const double z : {1.0, -1.0, 0.8, 0.3})
    for (const double level : {0.0, 0.1, -0.2}) {
      const auto found = project({4, 5, z}, level);
      ASSERT_TRUE(found) << z;
      EXPECT_LE(std::abs(kinked.value(*found) - level), kTolerance);
      EXPECT_EQ(found->x(), 4);
      EXPECT_EQ(found->y(), 5);
    }
}

TEST(SurfaceProjection, ReachesTheSurfaceOnFlatAndSteepSlopes) {
  for (const double slope : {0.5, 0.8, 1.3, 2.0}) {
    const Layered ramp([=](double z) { return std::pair(slope * z, slope); });
    const auto found = SurfaceProjection(ramp, kTolerance)({0, 0, 0.9}, 0);
    ASSERT_TRUE(found) << slope;
    EXPECT_LE(std::abs(ramp.value(*found)), kTolerance) << slope;
  }
}

TEST(SurfaceProjection, GivesUpWherePhiIsClamped) {
  const test::AnalyticSphere sphere(Vector3d::Zero(), 5, {.band = 1});
  EXPECT_FALSE(SurfaceProjection(sphere, kTolerance)({9, 0, 0}, 0));
}

TEST(SurfaceProjection, GivesUpOnALevelThatDoesNotExist) {
  const Layered valley([](double z) { return std::pair(z * z + 0.5, 2 * z); });
  EXPECT_FALSE(SurfaceProjection(valley, kTolerance)({0, 0, 0.7}, 0));
}

}  // namespace
}  // namespace sinew
