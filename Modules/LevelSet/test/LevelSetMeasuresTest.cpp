#include "Sampling.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetMeasures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sinew {
namespace {

using Eigen::Vector3d;

template <typename Function>
LevelSet narrowBandOf(const Function& phi) {
  const DenseField field = test::sampled({60, 60, 60}, Vector3d::Constant(-14.9), Vector3d::Constant(0.5),
                                         [&](const Vector3d& x) { return std::clamp(phi(x), -2.0, 2.0); });
  return levelSetFromField({field, Eigen::Isometry3d::Identity(), 0.5, 2});
}

double ball(const Vector3d& x, const Vector3d& centre, double radius) { return (x - centre).norm() - radius; }
double torusOf8(const Vector3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 8, x.z()) - 3; }

TEST(LevelSetMeasures, VolumesOfBallAndTorus) {
  const double pi = std::numbers::pi;
  const LevelSet sphere = narrowBandOf([](const Vector3d& x) { return ball(x, {0.1, 0.2, 0}, 10); });
  EXPECT_NEAR(levelSetVolume(sphere) / (4 * pi / 3 * 1000), 1, 1e-4) << "20 voxels of radius: fourth order";
  EXPECT_NEAR(levelSetVolume(narrowBandOf(torusOf8)) / (2 * pi * pi * 8 * 9), 1, 1e-3)
      << "6 voxels of radius";
}

TEST(LevelSetMeasures, EulerCharacteristicTellsBallTorusShellAndPair) {
  const auto topology = [](auto&& phi) { return levelSetTopology(narrowBandOf(phi)); };
  const LevelSetTopology one = topology([](const Vector3d& x) { return ball(x, {0, 0, 0}, 10); });
  EXPECT_EQ(one.components, 1);
  EXPECT_EQ(one.eulerCharacteristic, 2);
  const LevelSetTopology ring = topology(torusOf8);
  EXPECT_EQ(ring.components, 1);
  EXPECT_EQ(ring.eulerCharacteristic, 0);
  const LevelSetTopology shell =
      topology([](const Vector3d& x) { return std::max(x.norm() - 10, 5 - x.norm()); });
  EXPECT_EQ(shell.components, 1);
  EXPECT_EQ(shell.eulerCharacteristic, 4) << "two spheres";
  const LevelSetTopology pair = topology([](const Vector3d& x) {
    return std::min(ball(x, {6, 0, 0}, 4), ball(x, {-6, 1, 2}, 5));
  });
  EXPECT_EQ(pair.components, 2);
  EXPECT_EQ(pair.eulerCharacteristic, 4);
}

TEST(LevelSetMeasures, DiagonalNeighboursAreJoinedByTheirValuesNotByTheirDirection) {
  // Two samples on a diagonal of a cell, 4 kinds of body diagonal: the cell's mean decides, the same for all
  // four.
  for (const double depth : {0.3, 1.9}) {
    std::vector<std::int64_t> counts;
    for (const Eigen::Vector3i& step : {Eigen::Vector3i(1, 1, 1), Eigen::Vector3i(-1, 1, 1),
                                        Eigen::Vector3i(1, -1, 1), Eigen::Vector3i(1, 1, -1)}) {
      DenseField field({16, 16, 16}, 0.2F);
      for (const Eigen::Vector3i& at :
           {Eigen::Vector3i(8, 8, 8), Eigen::Vector3i(Eigen::Vector3i(8, 8, 8) + step)})
        field(at.x(), at.y(), at.z()) = static_cast<float>(-depth);
      counts.push_back(
          levelSetTopology(levelSetFromField({field, Eigen::Isometry3d::Identity(), 1, 2})).components);
    }
    EXPECT_EQ(counts, std::vector<std::int64_t>(4, depth > 1 ? 1 : 2));
  }
}

TEST(LevelSetMeasures, EveryPieceOfNoiseHasAClosedSurface) {
  // A closed surface has an even Euler characteristic; a body of c pieces has at most 2 c plus its cavities'
  // spheres.
  DenseField field = test::sampled({24, 24, 24}, Vector3d::Zero(), Vector3d::Ones(), [](const Vector3d& x) {
    const bool border = (x.array() < 3).any() || (x.array() > 20).any();
    return border ? 1 : std::sin(12.9 * x.x() + 78.2 * x.y() + 37.7 * x.z());
  });
  const LevelSetTopology noise =
      levelSetTopology(levelSetFromField({field, Eigen::Isometry3d::Identity(), 1, 3}));
  EXPECT_EQ(noise.eulerCharacteristic % 2, 0);
  EXPECT_GE(noise.components, 1);
}

TEST(LevelSetMeasures, AnEmptyLevelSetHasNothing) {
  const LevelSet nothing = narrowBandOf([](const Vector3d&) { return 1.9; });
  EXPECT_EQ(levelSetTopology(nothing).components, 0);
  EXPECT_EQ(levelSetVolume(nothing), 0);
}

TEST(LevelSetMeasures, TheNumberOfThreadsDoesNotShow) {
  const LevelSet sphere = narrowBandOf(torusOf8);
  const auto run = [&] { return levelSetVolume(sphere); };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

}  // namespace
}  // namespace sinew
