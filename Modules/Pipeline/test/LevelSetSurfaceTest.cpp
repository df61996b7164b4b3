#include "LevelSetSurface.h"
#include "SampledLevelSet.h"
#include "sinew/LevelSet/LevelSetGrid.h"

#include <gtest/gtest.h>
#include <openvdb/tools/Interpolation.h>

#include <cmath>
#include <random>

namespace sinew {
namespace {

using test::sampled;

double sphere(const Eigen::Vector3d& x, const Eigen::Vector3d& center, double radius) {
  return (x - center).norm() - radius;
}

double torus(const Eigen::Vector3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 20, x.z()) - 6; }

LevelSet bigSphere(double voxelSize = 1) {
  return sampled(
      [](const Eigen::Vector3d& x) {
        return sphere(x, {-3.3, 7.1, 1.4}, 21);
      },
      Eigen::Vector3i(-30, -20, -26), Eigen::Vector3i(25, 35, 30), voxelSize);
}

LevelSetTopology topologyOf(const std::function<double(const Eigen::Vector3d&)>& phi) {
  return levelSetTopology(
      LevelSetSurface(sampled(phi, Eigen::Vector3i::Constant(-30), Eigen::Vector3i::Constant(30))));
}

TEST(LevelSetSurface, ValuesAreOpenVdbsTrilinearSamples) {
  const LevelSet levelSet = bigSphere(0.4);
  const LevelSetSurface surface(levelSet);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-40, 45);  // also beyond the box on every side
  for (int trial = 0; trial < 20000; ++trial) {
    const Eigen::Vector3d index(uniform(random), uniform(random), uniform(random));
    const float expected = openvdb::tools::BoxSampler::sample(
        levelSet.grid->grid->tree(), openvdb::Vec3d(index.x(), index.y(), index.z()));
    // OpenVDB interpolates in float: a few units in the last place of values up to 1.2.
    ASSERT_NEAR(surface.value(0.4 * index), expected, 2e-6) << "seed 1: " << index.transpose();
  }
}

TEST(LevelSetSurface, GridNodesAreExact) {
  const LevelSet levelSet = bigSphere();
  const LevelSetSurface surface(levelSet);
  for (const Eigen::Vector3i& node :
       {Eigen::Vector3i(16, 7, 1), Eigen::Vector3i(-24, 8, 0), Eigen::Vector3i(-8, -16, 8)})
    EXPECT_EQ(surface.value(node.cast<double>()),
              levelSet.grid->grid->tree().getValue({node.x(), node.y(), node.z()}));
}

TEST(LevelSetSurface, TheGradientIsThatOfTheInterpolant) {
  const LevelSetSurface surface(bigSphere(0.5));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-15, 15);
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
  EXPECT_EQ(surface.valueAndGradient({-1.65, 3.55, 0.7}, gradient), -1.5);
  EXPECT_EQ(gradient, Eigen::Vector3d::Zero());
  EXPECT_EQ(surface.valueAndGradient({1e9, 0, 0}, gradient), 1.5);
  EXPECT_EQ(gradient, Eigen::Vector3d::Zero());
  EXPECT_EQ(surface.value({NAN, 0, 0}), 1.5);
}

TEST(LevelSetSurface, BoundsHoldTheShape) {
  const LevelSetSurface surface(bigSphere(0.5));
  EXPECT_EQ(surface.bounds().min(), Eigen::Vector3d(-15, -10, -13));
  EXPECT_EQ(surface.bounds().max(), Eigen::Vector3d(12.5, 17.5, 15));
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
