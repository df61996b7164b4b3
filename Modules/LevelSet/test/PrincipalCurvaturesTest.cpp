#include "Sampling.h"
#include "sinew/LevelSet/FastMarching.h"
#include "sinew/LevelSet/PrincipalCurvatures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::sampled;

const Vector3d kOrigin = Vector3d::Constant(-15.7);

template <typename Function>
DenseField raster(const Function& f) {
  return sampled(Vector3i::Constant(32), kOrigin, Vector3d::Ones(), f);
}

/// visit(x, k1, k2) for the samples with |phi| < 1, two away from the border.
template <typename Visit>
void forEachNear(const DenseField& phi, const Visit& visit) {
  const CurvatureFields fields = principalCurvatures(phi, 1, 1);
  int visited = 0;
  for (int k = 2; k < 30; ++k)
    for (int j = 2; j < 30; ++j)
      for (int i = 2; i < 30; ++i) {
        if (!(std::abs(phi(i, j, k)) < 1)) continue;
        visit(Vector3d(kOrigin + Vector3d(i, j, k)), double{fields.k1(i, j, k)}, double{fields.k2(i, j, k)});
        ++visited;
      }
  EXPECT_GT(visited, 100);
}

double curvedTorus(const Vector3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 9, x.z()) - 4.5; }

TEST(PrincipalCurvatures, ATorusHasOneOverRAndCosTOverItsDistanceFromTheAxis) {
  double worst = 0, sum = 0;
  int count = 0;
  forEachNear(raster(curvedTorus), [&](const Vector3d& x, double k1, double k2) {
    const double axis = std::hypot(x.x(), x.y()), r = std::hypot(axis - 9, x.z());
    const double across = 1 / r, around = (axis - 9) / r / axis;  // cos t / (R + r cos t)
    const double miss =
        std::max(std::abs(k1 - std::max(across, around)), std::abs(k2 - std::min(across, around)));
    worst = std::max(worst, miss * r);
    sum += miss * r;
    ++count;
  });
  // Central differences at r = 3.5: (h/r)^2 / 8 is 1 %.
  EXPECT_LT(sum / count, 0.01);
  EXPECT_LT(worst, 0.03);
}

TEST(PrincipalCurvatures, TheErrorFallsWithTheSquareOfTheSpacing) {
  const auto error = [](double h) {
    const Vector3d origin = Vector3d::Constant(-4.1), at(4.1 / h + 3 / h, 4.1 / h, 4.1 / h);
    const DenseField phi = sampled(Vector3i::Constant(static_cast<int>(8.4 / h)), origin,
                                   Vector3d::Constant(h), [](const Vector3d& x) { return x.norm() - 3; });
    const Vector3i i = at.array().round().cast<int>();
    const Vector3d x = origin + h * i.cast<double>();
    return std::abs(principalCurvatures(phi, h, i).k1 * x.norm() - 1);
  };
  EXPECT_NEAR(error(0.5) / error(0.25), 4, 1);
}

TEST(PrincipalCurvatures, ASaddleHasOppositeOnes) {
  const DenseField phi =
      raster([](const Vector3d& x) { return x.z() - 0.02 * (x.x() * x.x() - x.y() * x.y()); });
  const PrincipalCurvatures c = principalCurvatures(phi, 1, {16, 16, 16});
  EXPECT_NEAR(c.k1, -c.k2, 1e-3);
  EXPECT_NEAR(c.k1, 0.04, 1e-3);
}

TEST(PrincipalCurvatures, TheScaleOfPhiDoesNotMatterAndItsSignDoes) {
  const DenseField phi = raster(curvedTorus);
  DenseField turned = phi;
  for (float& v : turned.values) v *= -3;
  const Vector3i at(16, 27, 18);
  const PrincipalCurvatures c = principalCurvatures(phi, 0.5, at), t = principalCurvatures(turned, 0.5, at);
  EXPECT_NEAR(t.k1, -c.k2, 1e-4);
  EXPECT_NEAR(t.k2, -c.k1, 1e-4);
}

TEST(PrincipalCurvatures, SurviveAMarchFromTwoLayersOfClosestPoints) {
  DenseField phi = raster([](const Vector3d& x) { return 1.5 * (x.norm() - 10); });
  fastMarching(phi, Vector3d::Ones(), 4, {.closestPointLayers = 3});
  double sum = 0;
  int count = 0;
  forEachNear(phi, [&](const Vector3d& x, double k1, double k2) {
    sum += std::abs(k1 * x.norm() - 1) + std::abs(k2 * x.norm() - 1);
    count += 2;
  });
  EXPECT_LT(sum / count, 0.02);
}

TEST(PrincipalCurvatures, FlatIsZeroAndSoIsAFieldWithoutSlope) {
  const DenseField plane = raster([](const Vector3d& x) { return x.dot(Vector3d(1, 2, 2)) / 3; });
  const PrincipalCurvatures c = principalCurvatures(plane, 1, {9, 9, 9});
  EXPECT_NEAR(c.k1, 0, 1e-5);
  EXPECT_NEAR(c.k2, 0, 1e-5);
  const PrincipalCurvatures flat = principalCurvatures(DenseField({3, 3, 3}, 1.0F), 1, {1, 1, 1});
  EXPECT_EQ(flat.k1, 0);
  EXPECT_EQ(flat.k2, 0);
}

TEST(PrincipalCurvatures, RefusesSamplesOutsideAndSpacingThatIsNotPositive) {
  const DenseField phi({3, 3, 3}, 1.0F);
  EXPECT_THROW(principalCurvatures(phi, 1, {3, 0, 0}), std::invalid_argument);
  EXPECT_THROW(principalCurvatures(phi, 0, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(principalCurvatures(phi, -1, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
