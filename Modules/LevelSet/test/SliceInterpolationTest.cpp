#include "Sampling.h"
#include "sinew/LevelSet/SliceInterpolation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::sampled;

constexpr double kPixel = 0.3, kSlice = 1;
constexpr double kLimit = 50;

/// Slices at z = 0, 1, ...: signed distance within the slice to the contour of a body of revolution,
/// radius(z).
template <typename Radius>
DenseField revolution(int slices, const Radius& radius) {
  return sampled({81, 81, slices}, {-12, -12, 0}, {kPixel, kPixel, kSlice}, [&](const Vector3d& x) {
    return std::clamp(std::hypot(x.x(), x.y()) - radius(x.z()), -kLimit, kLimit);
  });
}

std::vector<double> everyThird(int slices) {
  std::vector<double> positions;
  for (int n = 0; n <= 3 * (slices - 1); ++n) positions.push_back(std::min(n / 3.0, slices - 1.0));
  return positions;
}

/// Volume of phi < 0, by the area of every plane: pixels count with 1/2 - phi/pixel.
double volumeOf(const DenseField& phi, double step) {
  double sum = 0;
  for (const float v : phi.values) sum += std::clamp(0.5 - v / kPixel, 0.0, 1.0);
  return sum * kPixel * kPixel * step;
}

TEST(SliceInterpolation, AConeIsRepeatedExactly) {
  // radius falls by 2 mm per slice: far steeper than voxels can show. The distances are linear in z.
  const auto radius = [](double z) { return z < 0.5 || z > 4.5 ? -kLimit : 11 - 2 * z; };
  const DenseField slices = revolution(6, radius);
  const DenseField phi = interpolateSlices(slices, kSlice, {2.25, 2.5, 2.75}, kLimit);
  for (int n = 0; n < 3; ++n)
    for (int i = 0; i < 81; ++i) {
      const double exact = std::abs(-12 + kPixel * i) - (11 - 2 * (2.25 + 0.25 * n));
      ASSERT_NEAR(phi(i, 40, n), exact, 1e-4) << "float at a limit of 50 mm";
    }
}

TEST(SliceInterpolation, PlanesOnSlicesAreTheSlices) {
  const DenseField slices =
      revolution(6, [](double z) { return z > 0.5 && z < 4.5 ? 5 + std::sin(z) : -kLimit; });
  const DenseField phi = interpolateSlices(slices, kSlice, {2, 3}, kLimit);
  for (int j = 0; j < 81; ++j)
    for (int i = 0; i < 81; ++i) ASSERT_NEAR(phi(i, j, 1), slices(i, j, 3), 1e-5);
}

TEST(SliceInterpolation, ASlopedCylinderBetweenSlicesIsSmooth) {
  const auto axis = [](double z) { return 0.8 * z - 2.4; };
  const auto cylinder = [&](const Vector3d& x) { return std::hypot(x.x() - axis(x.z()), x.y()) - 5; };
  const DenseField slices =
      sampled({81, 81, 7}, {-12, -12, 0}, {kPixel, kPixel, kSlice},
              [&](const Vector3d& x) { return x.z() < 0.5 || x.z() > 5.5 ? kLimit : cylinder(x); });
  const DenseField phi = interpolateSlices(slices, kSlice, {2.5, 3.5}, kLimit);
  for (int n = 0; n < 2; ++n)
    for (int j = 0; j < 81; ++j)
      for (int i = 0; i < 81; ++i) {
        const double exact = cylinder({-12 + kPixel * i, -12 + kPixel * j, 2.5 + n});
        // Catmull-Rom's own error where the axis moves 0.8 mm per slice: |x|'''' of the circle, a few 1e-2
        // mm.
        if (std::abs(exact) < 1) {
          ASSERT_NEAR(phi(i, j, n), exact, 0.05);
        }
      }
}

TEST(SliceInterpolation, ACapKeepsHalfASlicesVolume) {
  // A cylinder on slices 2, 3, 4 of 0..6: its voxels fill 3 mm of height.
  for (const double r : {0.8, 3.0, 10.0}) {
    const DenseField slices = revolution(7, [&](double z) { return z > 1.5 && z < 4.5 ? r : -kLimit; });
    const DenseField phi = interpolateSlices(slices, kSlice, everyThird(7), kLimit);
    const double voxels = std::numbers::pi * r * r * 3;
    // The rim's rounding and the planes' spacing; without caps the far distance eats nearly all of the ends:
    // -33 %.
    EXPECT_NEAR(volumeOf(phi, kSlice / 3) / voxels, 1, 0.015 + 0.25 * kPixel / r) << "radius " << r;
    EXPECT_LT(phi(40, 40, 6), 0) << "slice 2";
    EXPECT_GT(phi(40, 40, 2), 0) << "two thirds of a slice, and the cap reaches " << r;
  }
}

TEST(SliceInterpolation, ABranchWithoutCounterpartKeepsItsHalfSlice) {
  // Two columns; the second one ends at slice 3 while the first goes on 8 mm away.
  const auto disc = [](const Vector3d& x, double cx) { return std::hypot(x.x() - cx, x.y()) - 2; };
  const DenseField slices =
      sampled({81, 81, 8}, {-12, -12, 0}, {kPixel, kPixel, kSlice}, [&](const Vector3d& x) {
        if (x.z() < 0.5 || x.z() > 6.5) return kLimit;
        return x.z() < 3.5 ? std::min(disc(x, -4), disc(x, 4)) : disc(x, -4);
      });
  const DenseField phi = interpolateSlices(slices, kSlice, everyThird(8), kLimit);
  const double voxels = std::numbers::pi * 4 * (6 + 3);
  EXPECT_NEAR(volumeOf(phi, kSlice / 3) / voxels, 1, 0.06);
}

TEST(SliceInterpolation, AHoleEndsLikeAPieceOfTissue) {
  const auto ring = [](double z) { return z > 2.5 && z < 4.5; };
  const DenseField slices =
      sampled({81, 81, 8}, {-12, -12, 0}, {kPixel, kPixel, kSlice}, [&](const Vector3d& x) {
        if (x.z() < 0.5 || x.z() > 6.5) return kLimit;
        const double r = std::hypot(x.x(), x.y());
        return ring(x.z()) ? std::max(r - 9, 3 - r) : r - 9;
      });
  const DenseField phi = interpolateSlices(slices, kSlice, everyThird(8), kLimit);
  const double voxels = std::numbers::pi * (81 * 6 - 9 * 2);
  EXPECT_NEAR(volumeOf(phi, kSlice / 3) / voxels, 1, 0.02);
  EXPECT_GT(phi(40, 40, 10), 0) << "slice 3 and a third: the cavity is there";
}

TEST(SliceInterpolation, AThinTubeThatRunsAslantIsJoined) {
  // Discs of 1.2 mm that move by 2.3 mm per slice: they touch at their rims. Four mid-planes between five
  // slices.
  const DenseField slices =
      sampled({81, 41, 7}, {-12, -6, 0}, {kPixel, kPixel, kSlice}, [&](const Vector3d& x) {
        return x.z() < 0.5 || x.z() > 5.5 ? kLimit : std::hypot(x.x() - 2.3 * (x.z() - 3), x.y()) - 1.2;
      });
  const DenseField phi = interpolateSlices(slices, kSlice, {1.5, 2.5, 3.5, 4.5}, kLimit);
  for (int n = 0; n < 4; ++n) {
    const int middle = static_cast<int>(std::lround((2.3 * (n - 1.5) + 12) / kPixel));
    EXPECT_LT(phi(middle, 20, n), -kPixel) << "plane " << n;
    std::int64_t pixels = 0;
    for (int j = 0; j < 41; ++j) {
      for (int i = 0; i < 81; ++i) pixels += phi(i, j, n) < 0;
    }
    // The mean area of the two discs; pixels of the discs' rims decide their counts.
    EXPECT_NEAR(static_cast<double>(pixels) * kPixel * kPixel / (std::numbers::pi * 1.44), 1, 0.1);
  }
}

TEST(SliceInterpolation, NoTissueAppearsBetweenEmptyNeighbours) {
  // 0.3 mm outside on two slices, then far outside: the cubic alone swings through zero.
  DenseField slices({1, 1, 4}, 0.3F);
  slices.values = {0.3F, 0.3F, 0.3F, 40};
  for (const float v : interpolateSlices(slices, kSlice, {1.2, 1.5, 1.8}, kLimit).values) EXPECT_GT(v, 0);
}

TEST(SliceInterpolation, TheNumberOfThreadsDoesNotShow) {
  const DenseField slices =
      revolution(7, [](double z) { return z > 0.5 && z < 5.5 ? 4 + 3 * std::sin(2 * z) : -kLimit; });
  const auto run = [&] { return interpolateSlices(slices, kSlice, everyThird(7), kLimit).values; };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(SliceInterpolation, RefusesPositionsOutOfRangeOrOutOfOrder) {
  const DenseField slices({2, 2, 3}, 1.0F);
  EXPECT_THROW(interpolateSlices(slices, 1, {0.5, 2.5}, 3), std::invalid_argument);
  EXPECT_THROW(interpolateSlices(slices, 1, {1, 0.5}, 3), std::invalid_argument);
  EXPECT_THROW(interpolateSlices(DenseField({2, 2, 1}), 1, {0}, 3), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
