#include "Sampling.h"
#include "SolidShapes.h"
#include "sinew/LevelSet/Csg.h"
#include "sinew/LevelSet/Offset.h"
#include "sinew/LevelSet/Redistance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::sampled;
using test::volumeOf;

/// rms and largest difference to a distance, where it is below `reach`.
struct Difference {
  double rms = 0, most = 0;
  Difference(const DenseLevelSet& levelSet, const Solid& exact, double reach) {
    int count = 0;
    test::forEachSample(levelSet, [&](const Vector3d& x, double phi) {
      const double distance = exact.phi(x);
      if (std::abs(distance) > reach) return;
      rms += (phi - distance) * (phi - distance);
      most = std::max(most, std::abs(phi - distance));
      ++count;
    });
    rms = std::sqrt(rms / count);
    EXPECT_GT(count, 100);
  }
};

const Vector3d kFrom(-8, 3, -6), kTo(9, -2, 8);

TEST(Offset, TheOffsetOfABallATorusAndACapsuleIsOne) {
  for (const double d : {-3.3, -1., -0.2, 0.4, 2.7, 9.}) {
    SCOPED_TRACE(d);
    for (const auto& [before, after] :
         {std::pair(sphere({1, 2, 3}, 12), sphere({1, 2, 3}, 12 + d)),
          std::pair(torus({0, 0, 0}, {1, 2, 9}, 20, 8), torus({0, 0, 0}, {1, 2, 9}, 20, 8 + d)),
          std::pair(capsule(kFrom, kTo, 8), capsule(kFrom, kTo, 8 + d))}) {
      const Difference surface(offset(sampled(before), d), after, 0.5);
      EXPECT_LT(surface.rms, 0.015);  // voxels; worst far from the old surface
      EXPECT_LT(surface.most, 0.08);
    }
  }
}

TEST(Offset, ABoxThatGrowsGetsRoundEdgesAndOneThatShrinksStaysSharp) {
  const Vector3d lower(-9, -8, -7), upper(10, 11, 12), one(1, 1, 1);
  const DenseLevelSet before = sampled(box(lower, upper));
  const Difference grown(offset(before, 5), box(lower - 5 * one, upper + 5 * one, 5), 0.5);
  EXPECT_LT(grown.rms, 0.04);  // voxels; worst around the corners
  EXPECT_LT(grown.most, 0.15);
  const DenseLevelSet shrunk = offset(before, -4);
  const Difference inner(shrunk, box(lower + 4 * one, upper - 4 * one), 0.5);
  EXPECT_LT(inner.rms, 0.15);  // no sample sees the sharp edge; the corners end a voxel earlier
  EXPECT_LT(inner.most, 1.05);
  EXPECT_NEAR(volumeOf(shrunk), 11. * 11 * 11, 0.01 * 11 * 11 * 11);
}

TEST(Offset, TheBoxGrowsAndShrinksWithTheShape) {
  const DenseLevelSet before = sampled(sphere({0, 0, 0}, 10));
  for (const double d : {-6., 7.}) {
    const DenseLevelSet after = offset(before, d);
    EXPECT_NEAR(after.phi.size.x(), 2 * (10 + d + 4) + 2, 3);
    EXPECT_TRUE(firstSampleOn({before.frame, before.voxelSize}, after).has_value());
    EXPECT_EQ(after.band, before.band);
    for (int k = 0; k < after.phi.size.z(); ++k)
      for (int j = 0; j < after.phi.size.y(); ++j) ASSERT_EQ(after.phi(0, j, k), 4);
  }
}

TEST(Offset, DeeperThanTheShapeNothingIsLeft) {
  for (const double d : {-5.1, -7., -100., -1e9})
    for (const float phi : offset(sampled(torus({0, 0, 0}, {0, 0, 1}, 12, 5)), d).phi.values)
      ASSERT_GT(phi, 0);
}

TEST(Offset, OffsetsAddUp) {
  const DenseLevelSet before = sampled(torus({0, 0, 0}, {1, 1, 1}, 16, 6));
  const double once = volumeOf(offset(before, 2.2)), twice = volumeOf(offset(offset(before, 1.5), 0.7));
  EXPECT_NEAR(twice, once, 0.001 * once);
  EXPECT_EQ(offset(before, 0).phi.values, before.phi.values);
}

TEST(Offset, OpeningTakesAThinPlateAndLeavesABall) {
  DenseLevelSet both = unite(sampled(sphere({0, 0, 0}, 10)), sampled(box({5, -12, -1}, {24, 12, 1})));
  redistance(both);
  const DenseLevelSet opened = opening(both, 3);
  const double ball = volumeOf(sampled(sphere({0, 0, 0}, 10)));
  EXPECT_NEAR(volumeOf(opened), ball, 0.02 * ball);
  test::forEachSample(opened, [&](const Vector3d& x, double phi) { ASSERT_TRUE(x.x() < 13 || phi > 0); });
}

TEST(Offset, ClosingFillsAGapAndLeavesABall) {
  const Solid ball = sphere({0, 0, 0}, 10);
  DenseLevelSet cut = subtract(sampled(ball), sampled(box({-12, -12, -1}, {12, 12, 1})));
  redistance(cut);
  const DenseLevelSet closed = closing(cut, 2.5);
  const double whole = volumeOf(sampled(ball));
  EXPECT_GT(volumeOf(closed), 0.97 * whole);  // a groove stays along the rim
  EXPECT_LT(volumeOf(closed), 1.001 * whole);
  const Difference untouched(closing(sampled(ball), 4), ball, 0.5);
  EXPECT_LT(untouched.rms, 0.03);  // marched out and back
  EXPECT_LT(untouched.most, 0.1);
}

TEST(Offset, OpeningTakesClosingAddsAndTwiceChangesLittleMoreThanOnce) {
  const SampleLattice lattice = test::tiltedLattice(0.5);
  DenseLevelSet shape =
      unite(sampled(capsule(kFrom, kTo, 5), 2, lattice), sampled(sphere({0, 5, 0}, 8), 2, lattice));
  redistance(shape);
  for (const auto& operation : {opening, closing}) {
    const DenseLevelSet once = operation(shape, 2), twice = operation(once, 2);
    EXPECT_NEAR(volumeOf(twice), volumeOf(once), 0.01 * volumeOf(once));
  }
  EXPECT_LE(volumeOf(opening(shape, 2)), volumeOf(shape));
  EXPECT_GE(volumeOf(closing(shape, 2)), volumeOf(shape));
}

TEST(Offset, TheNumberOfThreadsDoesNotShow) {
  const DenseLevelSet shape = sampled(torus({0, 0, 0}, {1, 1, 1}, 16, 6));
  const auto run = [&] { return offset(shape, 3).phi.values; };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(Offset, RefusesWhatIsNoLength) {
  const DenseLevelSet shape = sampled(sphere({0, 0, 0}, 5));
  EXPECT_THROW(offset(shape, std::nan("")), std::invalid_argument);
  EXPECT_THROW(offset(shape, 1e9), std::invalid_argument);
  EXPECT_THROW(opening(shape, -1), std::invalid_argument);
  EXPECT_THROW(closing(shape, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
