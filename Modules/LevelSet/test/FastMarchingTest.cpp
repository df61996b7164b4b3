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

double sphere(const Vector3d& x) { return x.norm() - 10; }
double torus(const Vector3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 9, x.z()) - 4.5; }
double plane(const Vector3d& x) { return x.dot(Vector3d(1, 2, 2)) / 3 - 0.37; }

TEST(FastMarching, DistanceToASphereAndATorusIsOfSecondOrder) {
  for (const auto& exact : {sphere, torus}) {
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
  const Error error = marchedError(0.5, Vector3d(1, 1.4, 2), 16, sphere);
  EXPECT_LT(error.mean, 0.01);
  EXPECT_LT(error.max, 0.1);
}

TEST(FastMarching, ZeroSetStaysWhereItIs) {
  // A true distance goes in, so every change beside the surface is a shift of the surface. LEVELSET's floor:
  // .003.
  const Vector3d origin = Vector3d::Constant(-15.7), one = Vector3d::Ones();
  DenseField phi = sampled({32, 32, 32}, origin, one, sphere);
  fastMarching(phi, one, 4);
  const Error beside = errorWithin(phi, origin, one, 0.5, sphere);
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
    DenseField phi = sampled({80, 80, 40}, {-19.6, -19.6, -19.6}, {0.5, 0.5, 1}, torus);
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

TEST(FastMarching, RefusesSpacingAndBandThatAreNotPositive) {
  DenseField phi({3, 3, 3}, 1.0F);
  EXPECT_THROW(fastMarching(phi, Vector3d(1, 0, 1), 3), std::invalid_argument);
  EXPECT_THROW(fastMarching(phi, Vector3d::Ones(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
