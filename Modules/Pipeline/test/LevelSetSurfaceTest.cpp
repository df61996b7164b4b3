#include "LevelSetSurface.h"
#include "SampledLevelSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sinew {
namespace {

using test::sampled;

double sphere(const Eigen::Vector3d& x, const Eigen::Vector3d& center, double radius) {
  return (x - center).norm() - radius;
}

double torus(const Eigen::Vector3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 20, x.z()) - 6; }

const Eigen::Vector3d kCentre(26.7, 27.1, 27.4);

DenseLevelSet bigSphere(double voxelSize = 1) {
  return sampled([](const Eigen::Vector3d& x) { return sphere(x, kCentre, 21); }, {0, 0, 0}, {55, 56, 54}, voxelSize);
}

/// @param phi  in voxels from the middle of the raster
LevelSetTopology topologyOf(const std::function<double(const Eigen::Vector3d&)>& phi) {
  const auto moved = [&](const Eigen::Vector3d& x) { return phi(x - Eigen::Vector3d::Constant(30)); };
  return levelSetTopology(
      LevelSetSurface(sampled(moved, Eigen::Vector3i::Zero(), Eigen::Vector3i::Constant(60))));
}

/// The sample at an index, +band beyond the raster.
double sampleAt(const DenseLevelSet& levelSet, int x, int y, int z) {
  const Eigen::Array3i at(x, y, z);
  return (at >= 0).all() && (at < levelSet.phi.size.array()).all() ? levelSet.phi(x, y, z) : levelSet.band;
}

/// sum over the corners of the cell of  prod_a (fraction_a or 1 - fraction_a) phi
double trilinear(const DenseLevelSet& levelSet, const Eigen::Vector3d& index) {
  const Eigen::Array3d lower = index.array().floor(), fraction = index.array() - lower;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3i bit(corner & 1, corner >> 1 & 1, corner >> 2);
    const Eigen::Array3i at = lower.cast<int>() + bit;
    sum += (bit == 1).select(fraction, 1 - fraction).prod() * sampleAt(levelSet, at.x(), at.y(), at.z());
  }
  return sum;
}

TEST(LevelSetSurface, ValuesAreTrilinear) {
  const DenseLevelSet levelSet = bigSphere(0.5);
  const LevelSetSurface surface(levelSet);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-10, 75);  // also beyond the raster on every side
  for (int trial = 0; trial < 20000; ++trial) {
    const Eigen::Vector3d index(uniform(random), uniform(random), uniform(random));
    // Rounding of positions up to 75, in voxels of 0.5 mm.
    ASSERT_NEAR(surface.value(0.5 * index), trilinear(levelSet, index), 1e-13)
        << "seed 1: " << index.transpose();
  }
}

TEST(LevelSetSurface, TheFacesOfTheRasterMixWithTheBand) {
  // Inside everywhere: a cell beside the raster still holds half of it.
  const LevelSetSurface surface(sampled([](const auto&) { return -1.0; }, {0, 0, 0}, {6, 7, 8}));
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d middle(3, 3, 3);
    for (const double beyond : {-0.5, 6.5 + axis}) {
      Eigen::Vector3d x = middle;
      x[axis] = beyond;
      EXPECT_EQ(surface.value(x), 0.5 * (-1 + 3)) << axis;
    }
  }
}

TEST(LevelSetSurface, GridNodesAreExact) {
  const DenseLevelSet levelSet = bigSphere();
  const LevelSetSurface surface(levelSet);
  for (const Eigen::Vector3i& node : {Eigen::Vector3i(46, 27, 27), Eigen::Vector3i(7, 31, 24),
                                      Eigen::Vector3i(24, 7, 32), Eigen::Vector3i(55, 56, 54)})
    EXPECT_EQ(surface.value(node.cast<double>()), levelSet.phi(node.x(), node.y(), node.z()));
}

TEST(LevelSetSurface, TheGradientIsThatOfTheInterpolant) {
  const LevelSetSurface surface(bigSphere(0.5));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 29);
  const double step = 1e-4;
  for (int trial = 0; trial < 5000; ++trial) {
    const Eigen::Vector3d x(uniform(random), uniform(random), uniform(random));
    Eigen::Vector3d gradient;
    ASSERT_EQ(surface.valueAndGradient(x, gradient), surface.value(x));
    const Eigen::Array3d fraction = (x / 0.5).array() - (x / 0.5).array().floor();
    if ((fraction < 1e-3).any() || (fraction > 1 - 1e-3).any()) continue;  // the gradient jumps between cells
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d h = step * Eigen::Vector3d::Unit(axis);
      // The interpolant is linear along an axis: only rounding, 1e-16 / step, is left.
      ASSERT_NEAR(gradient[axis], (surface.value(x + h) - surface.value(x - h)) / (2 * step), 1e-10)
          << "seed 2: " << x.transpose();
    }
  }
}

TEST(LevelSetSurface, IsFlatFarFromTheSurface) {
  const LevelSetSurface surface(bigSphere(0.5));
  Eigen::Vector3d gradient;
  EXPECT_EQ(surface.valueAndGradient(0.5 * kCentre, gradient), -1.5);
  EXPECT_EQ(gradient, Eigen::Vector3d::Zero());
  EXPECT_EQ(surface.valueAndGradient({1e9, 0, 0}, gradient), 1.5);
  EXPECT_EQ(gradient, Eigen::Vector3d::Zero());
  EXPECT_EQ(surface.value({NAN, 0, 0}), 1.5);
}

TEST(LevelSetSurface, BoundsHoldTheShape) {
  const LevelSetSurface surface(bigSphere(0.5));
  EXPECT_EQ(surface.bounds().min(), Eigen::Vector3d::Zero());
  EXPECT_EQ(surface.bounds().max(), Eigen::Vector3d(27.5, 28, 27));
  EXPECT_EQ(surface.resolution(), 0.5);
  EXPECT_EQ(surface.band(), 1.5);
}

TEST(LevelSetTopology, OneBallHasOneSphere) {
  const LevelSetTopology topology = topologyOf([](const auto& x) { return sphere(x, {0.3, 0.1, -0.7}, 24); });
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.eulerCharacteristic, 2);
}

TEST(LevelSetTopology, ATorusHasAHole) {
  const LevelSetTopology topology = topologyOf(torus);
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.eulerCharacteristic, 0);
}

TEST(LevelSetTopology, AShellHasTwoSurfaces) {
  const LevelSetTopology topology = topologyOf([](const auto& x) {
    return std::abs(sphere(x, {0.3, 0.1, -0.7}, 20)) - 4.5;
  });
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.eulerCharacteristic, 4);
}

TEST(LevelSetTopology, ComponentsAreCountedAcrossBricks) {
  const LevelSetTopology topology = topologyOf([](const Eigen::Vector3d& x) {
    return std::min({sphere(x, {-15, 0, 0}, 13), sphere(x, {15, 0, 0}, 13), sphere(x, {0, 20, 20}, 0.5)});
  });
  EXPECT_EQ(topology.components, 3);
  EXPECT_EQ(topology.eulerCharacteristic, 6);
}

}  // namespace
}  // namespace sinew
