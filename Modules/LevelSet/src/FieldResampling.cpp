#include "sinew/LevelSet/FieldResampling.h"

#include "Tricubic.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

/// Four source samples and their weights for one sample of the result.
struct Taps {
  std::array<int, 4> index;
  std::array<float, 4> weight;
};

std::vector<Taps> tapsAlong(int samples, double first, double step, int count) {
  std::vector<Taps> table(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double x = std::clamp(first + step * i, 0.0, static_cast<double>(samples - 1));
    const int base = std::min(static_cast<int>(x), std::max(samples - 2, 0));
    const CubicWeights w = cubicWeights(x - base);
    Taps& taps = table[static_cast<std::size_t>(i)];
    for (int s = 0; s < 4; ++s) {
      const auto at = static_cast<std::size_t>(s);
      taps.index[at] = std::clamp(base + s - 1, 0, samples - 1);
      taps.weight[at] = static_cast<float>(w.value[at]);
    }
  }
  return table;
}

float combine(const Taps& t, float a, float b, float c, float d) {
  return t.weight[0] * a + t.weight[1] * b + t.weight[2] * c + t.weight[3] * d;
}

/// Whether the eight samples around a point are equal: then so is the surface's neighbourhood, up to
/// overshoots.
bool isConstant(const DenseField& f, const Eigen::Vector3d& at) {
  Eigen::Vector3i low, high;
  for (int a = 0; a < 3; ++a) {
    low[a] = std::clamp(static_cast<int>(std::floor(at[a])), 0, f.size[a] - 1);
    high[a] = std::min(low[a] + 1, f.size[a] - 1);
  }
  const float value = f(low.x(), low.y(), low.z());
  for (const int k : {low.z(), high.z()})
    for (const int j : {low.y(), high.y()})
      if (f(low.x(), j, k) != value || f(high.x(), j, k) != value) return false;
  return true;
}

}  // namespace

DenseField resampleAxis(const DenseField& field, int axis, double first, double step, int count) {
  const std::vector<Taps> table = tapsAlong(field.size[axis], first, step, count);
  Eigen::Vector3i size = field.size;
  size[axis] = count;
  DenseField result(size);
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j) {
      float* out = result.row(j, k);
      if (axis == 0) {
        const float* in = field.row(j, k);
        for (int i = 0; i < count; ++i) {
          const Taps& t = table[static_cast<std::size_t>(i)];
          out[i] = combine(t, in[t.index[0]], in[t.index[1]], in[t.index[2]], in[t.index[3]]);
        }
        continue;
      }
      const Taps& t = table[static_cast<std::size_t>(axis == 1 ? j : k)];
      std::array<const float*, 4> in;
      for (std::size_t s = 0; s < 4; ++s)
        in[s] = axis == 1 ? field.row(t.index[s], k) : field.row(j, t.index[s]);
      for (int i = 0; i < size.x(); ++i) out[i] = combine(t, in[0][i], in[1][i], in[2][i], in[3][i]);
    }
  });
  return result;
}

DenseField resampleAffine(const DenseField& field, const Eigen::Affine3d& toField,
                          const Eigen::Vector3i& size) {
  DenseField result(size);
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) {
        const Eigen::Vector3d at = toField * Eigen::Vector3d(i, j, k);
        const Eigen::Vector3i nearest = at.array().round().cast<int>().matrix().cwiseMax(0).cwiseMin(
            field.size - Eigen::Vector3i::Ones());
        result(i, j, k) = isConstant(field, at) ? field(nearest.x(), nearest.y(), nearest.z())
                                                : static_cast<float>(tricubicSample(field, at).value);
      }
  });
  return result;
}

}  // namespace sinew
