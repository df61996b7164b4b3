#include "Sampling.h"
#include "SolidShapes.h"
#include "sinew/LevelSet/ResampleLevelSet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using test::sampled;
using test::volumeOf;

Affine3d turned(double degrees) {
  return Eigen::Translation3d(3.3, -2.1, 7.7) *
         Affine3d(Eigen::AngleAxisd(degrees * 3.14159265358979 / 180, Vector3d(2, 1, -1).normalized()));
}

double mostMiss(const DenseLevelSet& levelSet, const Solid& exact, double reach) {
  double most = 0;
  test::forEachSample(levelSet, [&](const Vector3d& x, double phi) {
    if (std::abs(exact.phi(x)) < reach) most = std::max(most, std::abs(phi - exact.phi(x)));
  });
  return most;
}

TEST(ResampleLevelSet, AMovedShapeIsTheShapeMoved) {
  const Solid still = torus({1, 2, 3}, {1, 1, 4}, 14, 6);
  Affine3d mirrored = turned(20);
  mirrored.linear().col(1) *= -1;
  for (const Affine3d& motion : {turned(0), turned(33), mirrored, turned(10) * Eigen::Scaling(1.4),
                                 turned(10) * Eigen::Scaling(0.7)}) {
    const DenseLevelSet result = resampled(sampled(still), test::tiltedLattice(), 4, motion);
    const Solid exact = moved(still, motion);
    EXPECT_LT(mostMiss(result, exact, 0.5), 0.015);  // tricubic, curvature 1/4
    EXPECT_LT(mostMiss(result, exact, 3), 0.2);      // the march
    EXPECT_NEAR(volumeOf(result), volumeOf(sampled(exact)), 0.002 * volumeOf(result));
    EXPECT_EQ(result.band, 4);
    EXPECT_TRUE(firstSampleOn(test::tiltedLattice(), result).has_value());
  }
}

TEST(ResampleLevelSet, AnotherLatticeHasTheSameShape) {
  const Solid ball = sphere({1, 2, 3}, 10);
  for (const SampleLattice& lattice : {SampleLattice(), test::tiltedLattice(0.6), test::tiltedLattice(1.7)}) {
    const DenseLevelSet result = resampled(sampled(ball), lattice, 3 * lattice.spacing);
    EXPECT_LT(mostMiss(result, ball, 0.5 * lattice.spacing), 0.015);
    EXPECT_EQ(result.voxelSize, lattice.spacing);
    EXPECT_EQ(result.band, 3 * lattice.spacing);
    EXPECT_TRUE(firstSampleOn(lattice, result).has_value());
  }
}

TEST(ResampleLevelSet, SamplesThatFitAreKept) {
  const SampleLattice lattice = test::tiltedLattice(0.5);
  const DenseLevelSet shape = sampled(cone({0, 0, 0}, {3, 4, 9}, 6), 2, lattice);
  const DenseLevelSet same = resampled(shape, lattice, 2);
  EXPECT_EQ(same.phi.values, shape.phi.values);
  // Three samples along the first axis, two back along the last.
  const Affine3d along(Eigen::Translation3d(lattice.frame.linear() * Vector3d(1.5, 0, -1)));
  EXPECT_EQ(resampled(shape, lattice, 2, along).phi.values, shape.phi.values);
  EXPECT_EQ(*firstSampleOn(lattice, resampled(shape, lattice, 2, along)),
            *firstSampleOn(lattice, shape) + Vector3i(3, 0, -2));
  const DenseLevelSet wider = resampled(shape, lattice, 3);
  EXPECT_EQ(wider.band, 3);
  EXPECT_NEAR(volumeOf(wider), volumeOf(shape), 0.01 * volumeOf(shape));  // the rim of the cone, marched
}

TEST(ResampleLevelSet, ThereAndBackAgainLosesLittle) {
  const DenseLevelSet shape = sampled(capsule({-8, 0, 0}, {8, 3, 4}, 5));
  const DenseLevelSet there = resampled(shape, test::tiltedLattice(), 4, turned(25));
  const DenseLevelSet back = resampled(there, test::tiltedLattice(), 4, turned(25).inverse());
  EXPECT_NEAR(volumeOf(back), volumeOf(shape), 0.002 * volumeOf(shape));
  EXPECT_LT(mostMiss(back, capsule({-8, 0, 0}, {8, 3, 4}, 5), 0.5), 0.02);
}

TEST(ResampleLevelSet, TheNumberOfThreadsDoesNotShow) {
  const DenseLevelSet shape = sampled(torus({1, 2, 3}, {1, 1, 4}, 14, 6));
  const auto run = [&] { return resampled(shape, test::tiltedLattice(), 4, turned(30)).phi.values; };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(ResampleLevelSet, RefusesWhatIsNoMotion) {
  const DenseLevelSet shape = sampled(sphere({0, 0, 0}, 5));
  Affine3d shear = Affine3d::Identity(), stretch = shear, flat = shear;
  shear(0, 1) = 0.01;
  stretch(2, 2) = 1.01;
  flat(2, 2) = 0;
  for (const Affine3d& motion : {shear, stretch, flat})
    EXPECT_THROW(resampled(shape, {}, 4, motion), std::invalid_argument);
  EXPECT_THROW(resampled(shape, {}, 0), std::invalid_argument);
  EXPECT_THROW(resampled(shape, {}, 4, Affine3d(Eigen::Scaling(1e5))), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
