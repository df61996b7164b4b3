#include "sinew/Mesher/Curvature.h"
#include "sinew/TestSupport/AnalyticDistance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// slope (z + c.x + (k1 x^2 + k2 y^2) / 2): principal curvatures k1, k2 at the origin when c = 0.
class Quadric : public SignedDistance {
 public:
  Quadric(double k1, double k2, double slope) : k1_(k1), k2_(k2), slope_(slope) {}
  double value(const Vector3d& x) const override {
    return slope_ * (x.z() + (k1_ * x.x() * x.x() + k2_ * x.y() * x.y()) / 2);
  }
  double valueAndGradient(const Vector3d& x, Vector3d& gradient) const override {
    gradient = slope_ * Vector3d(k1_ * x.x(), k2_ * x.y(), 1);
    return value(x);
  }
  Eigen::AlignedBox3d bounds() const override { return {Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}; }
  double resolution() const override { return 1; }
  double band() const override { return 1; }

 private:
  double k1_, k2_, slope_;
};

TEST(Curvature, OfATorusWithinTwoPercent) {
  constexpr double R = 10, r = 3;
  const test::AnalyticTorus torus({1, -2, 3}, R, r);
  for (int n = 0; n < 48; ++n) {
    const double t = 2 * std::numbers::pi * n / 48, turn = 0.7 * n;
    const double rho = R + r * std::cos(t);
    const Vector3d x(1 + rho * std::cos(turn), -2 + rho * std::sin(turn), 3 + r * std::sin(t));
    const PrincipalCurvatures k = principalCurvatures(torus, x, r / 10);
    EXPECT_NEAR(k.k1, 1 / r, 0.02 / r) << "t = " << t;
    EXPECT_NEAR(k.k2, std::cos(t) / rho, 0.02 / r) << "t = " << t;
    EXPECT_DOUBLE_EQ(k.magnitude(), std::abs(k.k1) + std::abs(k.k2));
  }
}

TEST(Curvature, OfASphereAndItsCavity) {
  constexpr double radius = 5, step = 0.05;
  const auto ball = std::make_shared<test::AnalyticSphere>(Vector3d::Zero(), radius);
  const test::AnalyticDifference cavity(
      std::make_shared<test::AnalyticBox>(Vector3d::Constant(-20), Vector3d::Constant(20)), ball);
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(1, 2, 3), Vector3d(-1, 1, 0)}) {
    const Vector3d x = radius * direction.normalized();
    // Central differences err by (step / radius)^2 / 2 relative.
    const PrincipalCurvatures k = principalCurvatures(*ball, x, step),
                              hollow = principalCurvatures(cavity, x, step);
    EXPECT_NEAR(k.k1, 1 / radius, 1e-4 / radius);
    EXPECT_NEAR(k.k2, 1 / radius, 1e-4 / radius);
    EXPECT_NEAR(hollow.k1, -1 / radius, 1e-4 / radius);
    EXPECT_NEAR(hollow.k2, -1 / radius, 1e-4 / radius);
  }
}

TEST(Curvature, OfASaddleCancelsInTheMeanButNotInTheMagnitude) {
  // Central differences of a linear gradient are exact; the slope must not matter.
  for (const double slope : {1.0, 3.0, 0.5}) {
    const PrincipalCurvatures k = principalCurvatures(Quadric(-0.4, 0.4, slope), Vector3d::Zero(), 0.1);
    EXPECT_NEAR(k.k1, 0.4, 1e-12);
    EXPECT_NEAR(k.k2, -0.4, 1e-12);
    EXPECT_NEAR(k.magnitude(), 0.8, 1e-12);
  }
}

TEST(Curvature, LargestFirstWhateverTheAxes) {
  const PrincipalCurvatures k = principalCurvatures(Quadric(-0.1, -0.7, 1), Vector3d::Zero(), 0.1);
  EXPECT_NEAR(k.k1, -0.1, 1e-12);
  EXPECT_NEAR(k.k2, -0.7, 1e-12);
}

TEST(Curvature, OfAPlaneIsZero) {
  const test::AnalyticBox box(Vector3d::Constant(-20), Vector3d::Constant(20));
  const PrincipalCurvatures k = principalCurvatures(box, {20, 1, 2}, 0.5);
  EXPECT_EQ(k.k1, 0);
  EXPECT_EQ(k.k2, 0);
}

TEST(Curvature, OfNoSurfaceIsZero) {
  const test::AnalyticSphere clamped(Vector3d::Zero(), 5, {.band = 1});
  EXPECT_EQ(principalCurvatures(clamped, {20, 0, 0}, 0.5).magnitude(), 0);
}

}  // namespace
}  // namespace sinew
