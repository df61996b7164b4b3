#include "Sampling.h"
#include "sinew/LevelSet/FieldVolume.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace sinew {
namespace {

using test::sampled;

/// Counts the points of an n^3 raster of cells in the unit box that lie in the half space.
double countedFraction(double distance, const Eigen::Vector3d& normal, const Eigen::Vector3d& edges, int n) {
  int inside = 0;
  for (int i = 0; i < n * n * n; ++i) {
    const Eigen::Vector3d at((i % n + 0.5) / n - 0.5, (i / n % n + 0.5) / n - 0.5,
                             (i / n / n + 0.5) / n - 0.5);
    inside += distance + normal.dot(at.cwiseProduct(edges)) < 0;
  }
  return inside / static_cast<double>(n * n * n);
}

TEST(HalfSpaceFraction, AgreesWithCountingPoints) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE("seed 7");
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    Eigen::Vector3d normal(unit(random), unit(random), unit(random));
    if (trial % 4 == 1) normal.x() = 0;
    if (trial % 4 == 2) normal.head<2>() *= 1e-7;
    if (trial % 4 == 3) normal.y() = normal.z();
    normal.normalize();
    const Eigen::Vector3d edges(1, 0.4, 2);
    const double distance = unit(random);
    // A plane misses at most the cells that it cuts: about 1/n of them, half of those on average cancel.
    EXPECT_NEAR(halfSpaceFraction(distance, normal, edges), countedFraction(distance, normal, edges, 40),
                0.02)
        << normal.transpose() << " d " << distance;
  }
}

TEST(HalfSpaceFraction, KnowsTheCornersTheMiddleAndTheOutside) {
  const Eigen::Vector3d diagonal = Eigen::Vector3d::Ones().normalized(), cube = Eigen::Vector3d::Ones();
  EXPECT_DOUBLE_EQ(halfSpaceFraction(0, diagonal, cube), 0.5);
  EXPECT_DOUBLE_EQ(halfSpaceFraction(1, diagonal, cube), 0);
  EXPECT_DOUBLE_EQ(halfSpaceFraction(-1, diagonal, cube), 1);
  EXPECT_NEAR(halfSpaceFraction(0.25, Eigen::Vector3d::UnitY(), cube), 0.25, 1e-12);
  // The corner tetrahedron of edge 1/2: volume 1/48.
  EXPECT_NEAR(halfSpaceFraction(1 / std::sqrt(3.0), diagonal, cube), 1.0 / 48, 1e-12);
}

TEST(FieldVolume, OfASphereIsOfFourthOrder) {
  const auto relativeError = [](double radius) {
    const int n = static_cast<int>(2 * radius) + 9;
    const DenseField phi =
        sampled({n, n, n}, Eigen::Vector3d::Constant(-n / 2.0 + 0.27), Eigen::Vector3d::Ones(),
                [&](const Eigen::Vector3d& x) { return x.norm() - radius; });
    const double volume = 4 * std::numbers::pi / 3 * radius * radius * radius;
    return std::abs(fieldVolume(phi, Eigen::Vector3d::Ones()) / volume - 1);
  };
  // Counting the corners' straight cuts errs by 1/(2 R^2); with the mean over the voxel what remains is
  // higher order.
  EXPECT_LT(relativeError(5), 2e-3);
  EXPECT_LT(relativeError(10), 2e-4);
  EXPECT_LT(relativeError(20), 5e-5);
}

TEST(FieldVolume, OfALevelAndOfAnisotropicVoxels) {
  const Eigen::Vector3d spacing(0.5, 0.8, 1.1);
  const DenseField phi = sampled({60, 40, 30}, {-14.9, -15.7, -16}, spacing,
                                 [](const Eigen::Vector3d& x) { return x.norm() - 10; });
  const auto sphere = [](double r) { return 4 * std::numbers::pi / 3 * r * r * r; };
  EXPECT_NEAR(fieldVolume(phi, spacing) / sphere(10), 1, 2e-4);
  EXPECT_NEAR(fieldVolume(phi, spacing, 1.3) / sphere(11.3), 1, 2e-4);
  EXPECT_NEAR(fieldVolume(phi, spacing, -1.3) / sphere(8.7), 1, 2e-4);
}

TEST(FieldVolume, VolumeKeepingLevelFindsTheRadius) {
  const DenseField phi = sampled({41, 41, 41}, Eigen::Vector3d::Constant(-20), Eigen::Vector3d::Ones(),
                                 [](const Eigen::Vector3d& x) { return x.norm() - 12; });
  const double wanted = 4 * std::numbers::pi / 3 * std::pow(12.2, 3);
  // fieldVolume is good to 2e-4 at this radius: 2e-4 / 3 * 12 mm.
  EXPECT_NEAR(volumeKeepingLevel(phi, Eigen::Vector3d::Ones(), wanted, -0.5, 0.5), 0.2, 1e-3);
  EXPECT_NEAR(volumeKeepingLevel(phi, Eigen::Vector3d::Ones(), 2 * wanted, -0.5, 0.5), 0.5, 1e-12)
      << "the limit holds";
}

TEST(FieldVolume, TheNumberOfThreadsDoesNotShow) {
  const DenseField phi = sampled({41, 41, 41}, Eigen::Vector3d::Constant(-20), Eigen::Vector3d::Ones(),
                                 [](const Eigen::Vector3d& x) { return x.norm() - 12; });
  const auto run = [&] { return fieldVolume(phi, Eigen::Vector3d::Ones()); };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

}  // namespace
}  // namespace sinew
