#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sinew {

/// Catmull-Rom weights of four samples at -1, 0, 1, 2 for a point t in [0, 1], and their derivatives.
struct CubicWeights {
  std::array<double, 4> value;
  std::array<double, 4> slope;
};

inline CubicWeights cubicWeights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {
      {-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1, -1.5 * t3 + 2 * t2 + 0.5 * t, 0.5 * t3 - 0.5 * t2},
      {-1.5 * t2 + 2 * t - 0.5, 4.5 * t2 - 5 * t, -4.5 * t2 + 4 * t + 0.5, 1.5 * t2 - t}};
}

/// Value and gradient of the tricubic interpolant at a continuous index; beyond the raster lies the nearest
/// sample.
struct TricubicSample {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< per index
};

inline TricubicSample tricubicSample(const DenseField& f, const Eigen::Vector3d& at) {
  std::array<std::array<int, 4>, 3> index;
  std::array<CubicWeights, 3> w;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const int last = f.size[axis] - 1;
    const double x = std::clamp(at[axis], 0.0, static_cast<double>(last));
    const int base = std::min(static_cast<int>(x), std::max(last - 1, 0));
    w[a] = cubicWeights(x - base);
    for (int s = 0; s < 4; ++s) index[a][static_cast<std::size_t>(s)] = std::clamp(base + s - 1, 0, last);
  }
  TricubicSample result;
  for (std::size_t k = 0; k < 4; ++k) {
    double plane = 0, planeX = 0, planeY = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const float* row = f.row(index[1][j], index[2][k]);
      double line = 0, lineX = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double sample = row[index[0][i]];
        line += w[0].value[i] * sample;
        lineX += w[0].slope[i] * sample;
      }
      plane += w[1].value[j] * line;
      planeX += w[1].value[j] * lineX;
      planeY += w[1].slope[j] * line;
    }
    result.value += w[2].value[k] * plane;
    result.gradient += Eigen::Vector3d(w[2].value[k] * planeX, w[2].value[k] * planeY, w[2].slope[k] * plane);
  }
  return result;
}

}  // namespace sinew
