#include "Sampling.h"
#include "Shapes.h"
#include "sinew/LevelSet/ShapeMeasures.h"
#include "sinew/LevelSet/ShapeParts.h"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::ball;
using test::levelSetOf;

double volumeOfBall(double radius) { return 4 * std::numbers::pi / 3 * std::pow(radius, 3); }

/// Balls of radius 7, 4 and 2.5 apart from each other.
DenseLevelSet threeBalls() {
  return levelSetOf([](const Vector3d& x) {
    return std::min({ball({-8, -8, 0}, 7)(x), ball({10, 3, 0}, 4)(x), ball({0, 12, 5}, 2.5)(x)});
  });
}

TEST(ShapeParts, ComponentsAreTheBallsLargestFirst) {
  const std::vector<DenseLevelSet> parts = shapeComponents(threeBalls());
  ASSERT_EQ(parts.size(), 3U);
  const std::array radii{7.0, 4.0, 2.5};
  const std::array centers{Vector3d(-8, -8, 0), Vector3d(10, 3, 0), Vector3d(0, 12, 5)};
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(shapeVolume(parts[n]) / volumeOfBall(radii[n]), 1, 0.02) << "a ball of few samples";
    EXPECT_LT((shapeCentroid(parts[n]) - centers[n]).norm(), 0.02);
    EXPECT_EQ(shapeTopology(parts[n]).components, 1);
    EXPECT_TRUE(firstSampleOn({}, parts[n])) << "still on the lattice";
  }
}

TEST(ShapeParts, KeepLargestAndDropSmall) {
  const DenseLevelSet balls = threeBalls();
  EXPECT_NEAR(shapeVolume(keepLargest(balls)) / volumeOfBall(7), 1, 0.005);
  EXPECT_EQ(shapeTopology(keepLargest(balls, 2)).components, 2);
  EXPECT_EQ(keepLargest(balls, 3).phi.values, balls.phi.values) << "nothing to do";
  EXPECT_EQ(shapeTopology(dropSmall(balls, 0.5 * volumeOfBall(4))).components, 2);
  EXPECT_EQ(shapeTopology(dropSmall(balls, 1e9)).components, 0);
  EXPECT_THROW(keepLargest(balls, 0), std::invalid_argument);
}

TEST(ShapeParts, FillCavitiesUpToAVolume) {
  const DenseLevelSet hollow = levelSetOf([](const Vector3d& x) {
    return std::max({ball({0, 0, 0}, 16)(x), -ball({-6, 0, 0}, 5)(x), -ball({8, 0, 0}, 3)(x)});
  });
  ASSERT_EQ(shapeTopology(hollow), (ShapeTopology{1, 2}));
  const DenseLevelSet full = fillCavities(hollow);
  EXPECT_EQ(shapeTopology(full), (ShapeTopology{1, 0}));
  EXPECT_NEAR(shapeVolume(full) / volumeOfBall(16), 1, 1e-3);
  const DenseLevelSet half = fillCavities(hollow, 2 * volumeOfBall(3));
  EXPECT_EQ(shapeTopology(half), (ShapeTopology{1, 1}));
  EXPECT_NEAR(shapeVolume(half), volumeOfBall(16) - volumeOfBall(5), 0.002 * volumeOfBall(16));
}

double throughZ(const Vector3d& x, double radius) { return x.head<2>().norm() - radius; }

TEST(ShapeParts, FillHolesShutsATunnelAndLeavesWhatIsWiderOrBlind) {
  // A plate with a bore of 4 mm, one of 10 mm, a blind hole of 4 mm and a sharp inner corner (an L).
  const auto plate = [](const Vector3d& x) {
    const double slab = test::block({0, 0, 0}, {18, 18, 4})(x);
    const double wall = test::block({0, 16, 8}, {18, 2, 8})(x);
    const double bores = std::min(throughZ(x - Vector3d(-9, -9, 0), 2), throughZ(x - Vector3d(8, 4, 0), 5));
    const double blind = std::max(throughZ(x - Vector3d(9, -10, 0), 2), -x.z());
    return std::max(std::min(slab, wall), -std::min(bores, blind));
  };
  const DenseLevelSet bored = levelSetOf(plate, 24);
  const DenseLevelSet filled = fillHoles(bored, 6);
  const double bore = std::numbers::pi * 4 * 8;
  // The plug ends within a mm of the plate's faces: a closing leaves menisci.
  EXPECT_NEAR(shapeVolume(filled) - shapeVolume(bored), bore, 0.15 * bore);
  const auto at = [&](const DenseLevelSet& shape, int i, int j, int k) {
    return shape.phi(i + 24, j + 24, k + 24);
  };
  EXPECT_LT(at(filled, -9, -9, 0), 0) << "the bore is shut";
  EXPECT_GT(at(filled, 8, 4, 0), 3) << "the wide one is open";
  EXPECT_GT(at(filled, 9, -10, 3), 1) << "the blind one too";
  EXPECT_EQ(at(filled, 0, 10, 8), at(bored, 0, 10, 8)) << "no fillet in the corner";
  EXPECT_EQ(fillHoles(bored, 1).phi.values, bored.phi.values) << "narrower than all of them";
  EXPECT_THROW(fillHoles(bored, 0), std::invalid_argument);
}

TEST(ShapeParts, FillHolesFillsNarrowCavities) {
  const DenseLevelSet hollow = levelSetOf([](const Vector3d& x) {
    return std::max(ball({0, 0, 0}, 14)(x), -ball({3, 0, 0}, 2.5)(x));
  });
  EXPECT_EQ(shapeTopology(fillHoles(hollow, 6)), (ShapeTopology{1, 0}));
  EXPECT_EQ(shapeTopology(fillHoles(hollow, 3)), (ShapeTopology{1, 1})) << "wider than that";
}

}  // namespace
}  // namespace sinew
