#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace sinew::bench {

/// Runs at three sizes, timed by wall and by the CPU time of all threads.
inline void threeSizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(64)
      ->Arg(128)
      ->Arg(256)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime();
}

/// A ball that fills a raster of n^3 samples up to eight from the border: its distance, voxels, clamped to
/// `limit`.
inline DenseField ballDistance(int n, double limit) {
  DenseField field({n, n, n});
  const double middle = (n - 1) / 2.0, radius = middle - 8;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const double d = (Eigen::Vector3d(i, j, k) - Eigen::Vector3d::Constant(middle)).norm() - radius;
        field(i, j, k) = static_cast<float>(std::clamp(d, -limit, limit));
      }
    }
  }
  return field;
}

/// The ball's voxels.
inline DenseMask ballMask(int n) {
  const DenseField phi = ballDistance(n, 1);
  DenseMask mask(phi.size);
  std::transform(phi.values.begin(), phi.values.end(), mask.values.begin(),
                 [](float v) { return v < 0 ? 1 : 0; });
  return mask;
}

/// Slices of the ball, every fourth plane: each the distance to its circle.
inline DenseField ballSlices(int n) {
  DenseField field({n, n, n / 4});
  const double middle = (n - 1) / 2.0, radius = middle - 8;
  for (int k = 0; k < field.size.z(); ++k) {
    const double z = 4 * k - middle, squared = radius * radius - z * z;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const double rho = Eigen::Vector2d(i - middle, j - middle).norm();
        field(i, j, k) = static_cast<float>(squared > 0 ? rho - std::sqrt(squared) : 4 * n);
      }
    }
  }
  return field;
}

}  // namespace sinew::bench
