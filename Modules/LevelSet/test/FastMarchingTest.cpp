#include "Sampling.h"
#include "sinew/LevelSet/FastMarching.h"
#include "sinew/LevelSet/FieldVolume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::sampled;

struct Error {
  double mean = 0, max = 0;  ///< mm
};

/// Difference to the exact distance where that is below `within`.
template <typename Function>
Error errorWithin(const DenseField& phi, const Vector3d& origin, const Vector3d& spacing, double within,
                  const Function& exact) {
  Error error;
  std::int64_t count = 0;
  for (int k = 0; k < phi.size.z(); ++k)
    for (int j = 0; j < phi.size.y(); ++j)
      for (int i = 0; i < phi.size.x(); ++i) {
        const double d = exact(Vector3d(origin + spacing.cwiseProduct(Vector3d(i, j, k))));
        if (std::abs(d) > within) continue;
        const double miss = std::abs(phi(i, j, k) - d);
        error.mean += miss;
        error.max = std::max(error.max, miss);
        ++count;
      }
  error.mean /= static_cast<double>(count);
  return error;
}

/// Marches a field with the zero set of `exact` but a slope that is not 1, then compares.
template <typename Function>
Error marchedError(double h, const Vector3d& aspect, double halfWidth, const Function& exact) {
  const Vector3d spacing = h * aspect;
  const Vector3i size =
      (Vector3d::Constant(2 * halfWidth).cwiseQuotient(spacing)).array().round().cast<int>() + 1;
  const Vector3d origin = Vector3d::Constant(-halfWidth) + 0.31 * spacing;
  DenseField phi = sampled(size, origin, spacing, [&](const Vector3d& x) {
    const double d = exact(x);
    return d * (2 + 0.3 * std::sin(x.x()) + 0.2 * d);
  });
  fastMarching(phi, spacing, 4 * h);
  return errorWithin(phi, origin, spacing, 3 * h, exact);
}

double ballOf10(const Vector3d& x) { return x.norm() - 10; }
double torusOf9(const Vector3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 9, x.z()) - 4.5; }
double plane(const Vector3d& x) { return x.dot(Vector3d(1, 2, 2)) / 3 - 0.37; }

TEST(FastMarching, DistanceToASphereAndATorusIsOfSecondOrder) {
  for (const auto& exact : {ballOf10, torusOf9}) {
    const Error coarse = marchedError(1, Vector3d::Ones(), 16, exact);
    const Error fine = marchedError(0.5, Vector3d::Ones(), 16, exact);
    // The field's slope changes by 20 % from voxel to voxel on purpose: most of this is the cubic patches'
    // error.
    EXPECT_LT(coarse.mean, 0.025);
    EXPECT_LT(coarse.max, 0.16);
    EXPECT_GT(coarse.mean / fine.mean, 3.0) << "second order: a quarter of the error at half the spacing";
  }
}

TEST(FastMarching, ATiltedPlaneComesOutExact) {
  // Closest points and upwind differences are exact for a linear field; float and kSettled = 1e-4 voxels
  // remain.
  const Vector3d origin(-8.3, -8.1, -8.4), spacing(1, 1.1, 0.8);
  DenseField phi = sampled({17, 17, 22}, origin, spacing, [](const Vector3d& x) { return 2 * plane(x); });
  fastMarching(phi, spacing, 4);
  // At the raster's border the patches repeat the outermost samples.
  const DenseField exact = sampled(phi.size, origin, spacing, plane);
  for (int k = 7; k < 15; ++k) {
    for (int j = 5; j < 12; ++j) {
      for (int i = 5; i < 12; ++i) {
        if (std::abs(exact(i, j, k)) < 1.5) {
          ASSERT_NEAR(phi(i, j, k), exact(i, j, k), 2e-3);
        }
      }
    }
  }
}

TEST(FastMarching, WorksOnAnisotropicSpacing) {
  const Error error = marchedError(0.5, Vector3d(1, 1.4, 2), 16, ballOf10);
  EXPECT_LT(error.mean, 0.01);
  EXPECT_LT(error.max, 0.1);
}

TEST(FastMarching, ZeroSetStaysWhereItIs) {
  // A true distance goes in, so every change beside the surface is a shift of the surface. LEVELSET's floor:
  // .003.
  const Vector3d origin = Vector3d::Constant(-15.7), one = Vector3d::Ones();
  DenseField phi = sampled({32, 32, 32}, origin, one, ballOf10);
  fastMarching(phi, one, 4);
  const Error beside = errorWithin(phi, origin, one, 0.5, ballOf10);
  EXPECT_LT(beside.mean, 0.002);
  EXPECT_LT(beside.max, 0.01);
}

TEST(FastMarching, TwentyRunsKeepTheVolume) {
  const Vector3d one = Vector3d::Ones();
  const auto ball = [](const Vector3d& x) { return x.norm() - 20; };
  DenseField phi = sampled({52, 52, 52}, Vector3d::Constant(-25.7), one, ball);
  const double before = fieldVolume(phi, one);
  for (int run = 0; run < 20; ++run) fastMarching(phi, one, 4);
  // A first-order march loses 0.86 % at this radius.
  EXPECT_NEAR(fieldVolume(phi, one) / before, 1, 2e-3);
}

TEST(FastMarching, AThreeVoxelPlateKeepsItsPlace) {
  const Vector3d one = Vector3d::Ones(), origin(-8, -8, -7.8), normal = Vector3d(0.2, 0.1, 1).normalized();
  const auto plate = [&](const Vector3d& x) { return std::abs(x.dot(normal)) - 1.5; };
  DenseField phi = sampled({17, 17, 17}, origin, one, plate);
  fastMarching(phi, one, 4);
  // The cubic patches see the kink in the middle of the plate.
  EXPECT_LT(errorWithin(phi, origin, one, 0.6, plate).mean, 0.05);
}

TEST(FastMarching, NoSampleChangesSideAndTheBandIsClamped) {
  const Vector3d one = Vector3d::Ones();
  // Zeros, single samples and checkered noise: nothing here has a distance to speak of.
  DenseField noise = sampled({20, 20, 20}, Vector3d::Zero(), one, [](const Vector3d& x) {
    return std::round(4 * std::sin(17 * x.x() + 5 * x.y() * x.z()));
  });
  DenseField phi = noise;
  fastMarching(phi, one, 3);
  for (std::size_t n = 0; n < phi.values.size(); ++n) {
    ASSERT_EQ(phi.values[n] < 0, noise.values[n] < 0);
    ASSERT_LE(std::abs(phi.values[n]), 3);
  }
}

TEST(FastMarching, WithoutASurfaceTheFieldIsTheBand) {
  DenseField phi({4, 4, 4}, 0.5F);
  fastMarching(phi, Vector3d::Ones(), 3);
  for (const float v : phi.values) EXPECT_EQ(v, 3.0F);
}

TEST(FastMarching, TheNumberOfThreadsDoesNotShow) {
  const auto run = [] {
    DenseField phi = sampled({80, 80, 40}, {-19.6, -19.6, -19.6}, {0.5, 0.5, 1}, torusOf9);
    fastMarching(phi, {0.5, 0.5, 1}, 4);
    return phi.values;
  };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(FastMarching, TilesDoNotShow) {
  // A ball that crosses the seams of eight tiles, and the same ball moved into one: the samples agree.
  const auto ballAt = [](double middle) {
    const Vector3d centre = Vector3d::Constant(middle + 0.3);
    DenseField phi = sampled(Vector3i::Constant(static_cast<int>(middle) + 32), Vector3d::Zero(),
                             Vector3d::Ones(), [&](const Vector3d& x) { return (x - centre).norm() - 18; });
    fastMarching(phi, Vector3d::Ones(), 4.5);
    return phi;
  };
  const DenseField seams = ballAt(64), whole = ballAt(32);
  double worst = 0;
  for (int k = 0; k < 64; ++k) {
    for (int j = 0; j < 64; ++j) {
      for (int i = 0; i < 64; ++i)
        worst = std::max(worst, std::abs(double{seams(i + 32, j + 32, k + 32)} - whole(i, j, k)));
    }
  }
  // What runs sideways through the edge of a halo has lost most of its weight.
  EXPECT_LT(worst, 1e-3);
}

double blockOf7(const Vector3d& x) {
  const Vector3d q = x.cwiseAbs() - Vector3d(7, 5, 6);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

/// Mean error between 1 and 2.5 mm outside of a shape of half the size, when the samples nearer than 1 mm are
/// given: there the distance is smooth.
template <typename Function>
double errorFromExactSeeds(double h, int order, const Function& shape) {
  const auto exact = [&](const Vector3d& x) { return shape(2 * x) / 2; };
  const Vector3d spacing = h * Vector3d(1, 1.25, 0.8), origin = Vector3d::Constant(-9) + 0.31 * spacing;
  const Vector3i size = Vector3d::Constant(18).cwiseQuotient(spacing).cast<int>();
  const DenseField truth = sampled(size, origin, spacing, exact);
  std::vector<MarchSeed> seeds;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        if (std::abs(truth(i, j, k)) < 1) seeds.push_back({{i, j, k}, std::abs(truth(i, j, k))});
  DenseField phi = truth;
  marchFromSeeds(phi, seeds, spacing, 3, {.order = order});
  const auto beyondSeeds = [&](const Vector3d& x) { return exact(x) > 1 ? exact(x) : 1e9; };
  return errorWithin(phi, origin, spacing, 2.5, beyondSeeds).mean;
}

TEST(FastMarching, OrderOneHalvesAndOrderTwoQuartersTheErrorAtHalfTheSpacing) {
  for (const auto& shape : {ballOf10, torusOf9, blockOf7}) {
    const auto errors = [&](int order) {
      return Vector3d(errorFromExactSeeds(0.8, order, shape), errorFromExactSeeds(0.4, order, shape),
                      errorFromExactSeeds(0.2, order, shape));
    };
    const Vector3d first = errors(1), second = errors(2);
    EXPECT_NEAR(first[1] / first[2], 2, 0.4) << first.transpose();
    EXPECT_NEAR(second[1] / second[2], 4, 0.4) << second.transpose();
    EXPECT_LT(second[2], 0.2 * first[2]) << first.transpose() << " and " << second.transpose();
  }
}

TEST(FastMarching, LayersOfClosestPointsMakeTheDistanceNearTheSurfaceOfThirdOrder) {
  const Vector3d one = Vector3d::Ones();
  const auto meanError = [&](double radius, int layers) {
    const auto ball = [&](const Vector3d& x) { return x.norm() - radius; };
    const Vector3d origin = Vector3d::Constant(-radius - 5.7);
    DenseField phi = sampled(Vector3i::Constant(static_cast<int>(2 * radius) + 12), origin, one, ball);
    fastMarching(phi, one, 4, {.closestPointLayers = layers});
    return errorWithin(phi, origin, one, 1, ball).mean;
  };
  // In samples, twice the radius is half the spacing: distance over spacing falls by 2^2 and 2^3 - 1 of these
  // is spent on the ratio. The first step of a march from one layer is of first order.
  EXPECT_GT(meanError(20, 1), 1e-3);
  for (const int layers : {2, 3}) {
    EXPECT_LT(meanError(20, layers), 3e-4) << layers;
    EXPECT_GT(meanError(10, layers) / meanError(20, layers), 3.5) << layers;
  }
}

TEST(FastMarching, ASeedGivesTheUnsignedDistanceToAPoint) {
  const Vector3d spacing(0.5, 0.5, 1);
  DenseField phi({41, 41, 21});
  marchFromSeeds(phi, {{{20, 20, 10}, 3}, {{20, 20, 10}, 0.25}}, spacing, 6);
  EXPECT_EQ(phi(20, 20, 10), 0.25F) << "of two seeds at one sample the nearest counts";
  EXPECT_NEAR(phi(30, 20, 10), 5.25, 1e-5) << "along an axis differences are exact";
  EXPECT_NEAR(phi(20, 20, 5), 5.25, 1e-5);
  EXPECT_EQ(phi(40, 40, 20), 6.0F) << "the band";
  const Error error = errorWithin(phi, Vector3d(-10, -10, -10), spacing, 4,
                                  [](const Vector3d& x) { return x.norm() + 0.25; });
  // A point source is the worst case: the first step of a diagonal is off by 1 - 1/sqrt 3 spacings.
  EXPECT_LT(error.mean, 0.5);
}

TEST(FastMarching, SeedsKeepTheirDistanceAndDoNotReachAcross) {
  DenseField phi({9, 3, 3}, 1.0F);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 4; i < 9; ++i) phi(i, j, k) = -1;
  marchFromSeeds(phi, {{{0, 1, 1}, 1}, {{2, 1, 1}, 5}}, Vector3d::Ones(), 8);
  EXPECT_EQ(phi(2, 1, 1), 5) << "1 + 2 is less";
  EXPECT_NEAR(phi(1, 1, 1), 2, 1e-6);
  EXPECT_EQ(phi(4, 1, 1), -8.0F) << "no seed inside";
}

TEST(FastMarching, RefusesSeedsAndOptionsOutOfRange) {
  DenseField phi({3, 3, 3}, 1.0F);
  const Vector3d one = Vector3d::Ones();
  EXPECT_THROW(marchFromSeeds(phi, {{{3, 0, 0}, 1}}, one, 3), std::invalid_argument);
  EXPECT_THROW(marchFromSeeds(phi, {{{0, -1, 0}, 1}}, one, 3), std::invalid_argument);
  EXPECT_THROW(marchFromSeeds(phi, {{{0, 0, 0}, -1}}, one, 3), std::invalid_argument);
  EXPECT_THROW(marchFromSeeds(phi, {{{0, 0, 0}, std::nan("")}}, one, 3), std::invalid_argument);
  EXPECT_THROW(fastMarching(phi, one, 3, {.order = 3}), std::invalid_argument);
  EXPECT_THROW(fastMarching(phi, one, 3, {.closestPointLayers = 4}), std::invalid_argument);
}

TEST(FastMarching, RefusesSpacingAndBandThatAreNotPositive) {
  DenseField phi({3, 3, 3}, 1.0F);
  EXPECT_THROW(fastMarching(phi, Vector3d(1, 0, 1), 3), std::invalid_argument);
  EXPECT_THROW(fastMarching(phi, Vector3d::Ones(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
