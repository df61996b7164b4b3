#include "Sampling.h"
#include "sinew/LevelSet/SliceSmoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::sampled;

constexpr double kSlicePixel = 0.3;

/// A thick slab whose contour lies at x = edge(z) on slice z; slices are 1 mm apart.
template <typename Edge>
DenseField slab(const Edge& edge, double thickness = 6) {
  return sampled({51, 21, 12}, {-7.5, -3, 0}, {kSlicePixel, kSlicePixel, 1}, [&](const Vector3d& x) {
    const double beyond = x.x() - edge(x.z());
    return std::max(beyond, -thickness - beyond);
  });
}

/// Where row 10 of slice k crosses zero upward, mm.
double contour(const DenseField& d, int k) {
  int i = 50;
  while (d(i - 1, 10, k) >= 0) --i;
  const double low = d(i - 1, 10, k), high = d(i, 10, k);
  return -7.5 + kSlicePixel * (i - 1 + low / (low - high));
}

TEST(SliceSmoothing, AlternatingJitterOfHalfAPixelGoes) {
  const double jitter = 0.5 * kSlicePixel;
  DenseField d = slab([&](double z) { return std::lround(z) % 2 == 0 ? jitter : -jitter; });
  smoothAcrossSlices(d, kSlicePixel);
  // (1 2 1)/4 takes the alternating part away at once, but the outermost slices stay and are seen by their
  // neighbours.
  for (int k = 3; k < 9; ++k) EXPECT_NEAR(contour(d, k), 0, 0.15 * jitter) << "slice " << k;
}

TEST(SliceSmoothing, ASlopeStaysAndSoDoesAStepOfFivePixels) {
  const auto slope = [](double z) { return 0.4 * (z - 6); };
  DenseField d = slab(slope);
  smoothAcrossSlices(d, kSlicePixel);
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(contour(d, k), slope(k), 1e-5) << "float";
  const auto step = [](double z) { return z < 5.5 ? 0.0 : 5 * kSlicePixel; };
  d = slab(step);
  smoothAcrossSlices(d, kSlicePixel);
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(contour(d, k), step(k), 1e-5);
}

TEST(SliceSmoothing, AThinSheetIsLeftAlone) {
  const DenseField sheet =
      slab([](double z) { return std::lround(z) % 2 == 0 ? 0.1 : -0.1; }, 2.5 * kSlicePixel);
  DenseField d = sheet;
  smoothAcrossSlices(d, kSlicePixel);
  EXPECT_EQ(d.values, sheet.values);
}

TEST(SliceSmoothing, TheNumberOfThreadsDoesNotShow) {
  const auto run = [] {
    DenseField d = slab([](double z) { return 0.3 * std::sin(5 * z); });
    smoothAcrossSlices(d, kSlicePixel);
    return d.values;
  };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(SliceSmoothing, RefusesOptionsOutOfRange) {
  DenseField d({5, 5, 5});
  EXPECT_THROW(smoothAcrossSlices(d, 0), std::invalid_argument);
  EXPECT_THROW(smoothAcrossSlices(d, 1, {.passes = -1}), std::invalid_argument);
  EXPECT_THROW(smoothAcrossSlices(d, 1, {.tolerancePixels = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
