#include "Sampling.h"
#include "sinew/LevelSet/GaussianSmoothing.h"
#include "sinew/LevelSet/SurfaceLevel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::maskOf;

DenseField smoothedSurface(const DenseMask& mask, double iso = 0.5) {
  DenseField field = gaussianSmoothing(mask, Vector3d::Ones());
  subtractSurfaceLevel(field, mask, Vector3d::Ones(), iso);
  return field;
}

TEST(SurfaceLevel, AThickBlockKeepsTheIsoValue) {
  const DenseMask mask = maskOf({30, 30, 30}, [](int i, int, int) { return i >= 15; });
  const DenseField u = gaussianSmoothing(mask, Vector3d::Ones());
  const DenseField field = smoothedSurface(mask);
  for (std::size_t n = 0; n < u.values.size(); ++n) ASSERT_EQ(field.values[n], 0.5F - u.values[n]);
}

TEST(SurfaceLevel, AOneVoxelPlateAndAOneVoxelTubeSurvive) {
  const DenseField plate = smoothedSurface(maskOf({25, 25, 25}, [](int, int, int k) { return k == 12; }));
  EXPECT_LT(plate(12, 12, 12), 0);
  EXPECT_GT(plate(12, 12, 11), 0);
  EXPECT_GT(plate(12, 12, 13), 0);
  const DenseField tube =
      smoothedSurface(maskOf({25, 25, 25}, [](int, int j, int k) { return j == 12 && k == 12; }));
  EXPECT_LT(tube(12, 12, 12), 0);
  EXPECT_GT(tube(12, 13, 12), 0);
}

TEST(SurfaceLevel, AOneVoxelGapStaysOpen) {
  const DenseField field = smoothedSurface(maskOf({25, 25, 25}, [](int, int, int k) { return k != 12; }));
  EXPECT_GT(field(12, 12, 12), 0);
  EXPECT_LT(field(12, 12, 10), 0);
}

TEST(SurfaceLevel, SlicesAreSeparateWhereSigmaIsZero) {
  const DenseMask mask = maskOf({25, 25, 3}, [](int i, int, int k) { return k == 1 && i == 12; });
  DenseField field = gaussianSmoothing(mask, Vector3d(1, 1, 0));
  subtractSurfaceLevel(field, mask, Vector3d(1, 1, 0), 0.5);
  EXPECT_LT(field(12, 12, 1), 0);
  EXPECT_EQ(field(12, 12, 0), 0.5F);
}

TEST(SurfaceLevel, TheNumberOfThreadsDoesNotShow) {
  const DenseMask mask = maskOf({30, 31, 32}, [](int i, int j, int k) {
    return std::sin(i * 0.7) + std::sin(j * 0.9) > std::sin(k * 1.1);
  });
  const auto run = [&] { return smoothedSurface(mask).values; };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(SurfaceLevel, RefusesAMaskOfAnotherSize) {
  DenseField field({3, 3, 3});
  EXPECT_THROW(subtractSurfaceLevel(field, DenseMask({3, 3, 4}), Vector3d::Ones(), 0.5),
               std::invalid_argument);
}

}  // namespace
}  // namespace sinew
