#include "Sampling.h"
#include "sinew/LevelSet/GaussianSmoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace sinew {
namespace {

using test::maskOf;

TEST(GaussianSmoothing, AnImpulseBecomesTheProductOfThreeGausses) {
  const Eigen::Vector3d sigma(1, 0.7, 1.5);
  const DenseField u = gaussianSmoothing(
      maskOf({21, 21, 21}, [](int i, int j, int k) { return i == 10 && j == 10 && k == 10; }), sigma);
  const double peak = u(10, 10, 10);
  for (int d = -3; d <= 3; ++d) {
    // Ratios to the peak are free of the normalization; float keeps seven digits.
    EXPECT_NEAR(u(10 + d, 10, 10) / peak, std::exp(-d * d / (2 * sigma.x() * sigma.x())), 1e-6);
    if (std::abs(d) <= 2) {
      EXPECT_NEAR(u(10, 10 + d, 10) / peak, std::exp(-d * d / (2 * sigma.y() * sigma.y())), 1e-6);
    }
    EXPECT_NEAR(u(10, 10, 10 + d) / peak, std::exp(-d * d / (2 * sigma.z() * sigma.z())), 1e-6);
  }
  EXPECT_NEAR(std::accumulate(u.values.begin(), u.values.end(), 0.0), 1, 1e-6);
}

TEST(GaussianSmoothing, AConstantStaysAndAnAxisWithSigmaZeroIsLeftAlone) {
  for (const float v : gaussianSmoothing(DenseMask({5, 6, 7}, 1), Eigen::Vector3d(2, 1, 3)).values)
    EXPECT_NEAR(v, 1, 1e-6);  // rounding of the weights' sum
  const DenseMask slab = maskOf({8, 8, 8}, [](int, int, int k) { return k >= 4; });
  const DenseField u = gaussianSmoothing(slab, Eigen::Vector3d(1, 1, 0));
  for (std::size_t n = 0; n < u.values.size(); ++n) EXPECT_NEAR(u.values[n], slab.values[n], 1e-6);
}

TEST(GaussianSmoothing, TheNumberOfThreadsDoesNotShow) {
  const DenseMask mask =
      maskOf({40, 41, 42}, [](int i, int j, int k) { return (i * 7 + j * 3 + k * 5) % 4 == 0; });
  const auto run = [&] { return gaussianSmoothing(mask, Eigen::Vector3d(1, 1.3, 2)).values; };
  EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
}

TEST(GaussianSmoothing, RefusesANegativeSigma) {
  EXPECT_THROW(gaussianSmoothing(DenseMask({3, 3, 3}), Eigen::Vector3d(1, -1, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
