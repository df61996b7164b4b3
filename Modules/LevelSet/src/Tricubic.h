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
/// sample. Sums are in float, as the samples are: four of a row at a time.
struct TricubicSample {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< per index
};

inline TricubicSample tricubicSample(const DenseField& f, const Eigen::Vector3d& at) {
  using Four = Eigen::Array4f;
  std::array<std::array<int, 4>, 3> index;
  std::array<Four, 3> w, slope;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const int last = f.size[axis] - 1;
    const double x = std::clamp(at[axis], 0.0, static_cast<double>(last));
    const int base = std::min(static_cast<int>(x), std::max(last - 1, 0));
    const CubicWeights weights = cubicWeights(x - base);
    w[a] = Eigen::Map<const Eigen::Array4d>(weights.value.data()).cast<float>();
    slope[a] = Eigen::Map<const Eigen::Array4d>(weights.slope.data()).cast<float>();
    for (int s = 0; s < 4; ++s) index[a][static_cast<std::size_t>(s)] = std::clamp(base + s - 1, 0, last);
  }
  const std::array<int, 4>& x = index[0];
  const bool inARow = x[3] - x[0] == 3;
  Four sum = Four::Zero(), alongY = Four::Zero(), alongZ = Four::Zero();
  for (int k = 0; k < 4; ++k) {
    Four plane = Four::Zero(), planeY = Four::Zero();
    for (int j = 0; j < 4; ++j) {
      const float* row = f.row(index[1][static_cast<std::size_t>(j)], index[2][static_cast<std::size_t>(k)]);
      const Four line = inARow ? Four(Eigen::Map<const Four>(row + x[0]))
                               : Four(row[x[0]], row[x[1]], row[x[2]], row[x[3]]);
      plane += w[1][j] * line;
      planeY += slope[1][j] * line;
    }
    sum += w[2][k] * plane;
    alongY += w[2][k] * planeY;
    alongZ += slope[2][k] * plane;
  }
  const auto folded = [](const Four& weights, const Four& samples) {
    return static_cast<double>((weights * samples).sum());
  };
  return {folded(w[0], sum), {folded(slope[0], sum), folded(w[0], alongY), folded(w[0], alongZ)}};
}

}  // namespace sinew
