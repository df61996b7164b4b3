#include "sinew/LevelSet/SliceInterpolation.h"

#include "SliceGap.h"
#include "Tricubic.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

void checkPositions(const DenseField& slices, const std::vector<double>& positions) {
  if (slices.size.z() < 2) throw std::invalid_argument("interpolateSlices: at least two slices are needed");
  if (!std::is_sorted(positions.begin(), positions.end()) ||
      (!positions.empty() && (positions.front() < 0 || positions.back() > slices.size.z() - 1)))
    throw std::invalid_argument("interpolateSlices: positions must ascend within the slices");
}

/// The value between b and c. Where b and c agree in sign, so does the result: at least half of what a
/// straight line between them has, for the cubic can swing through zero beside a jump.
float keepSign(float cubic, float linear, float b, float c) {
  if ((b < 0) != (c < 0)) return cubic;
  return linear < 0 ? std::min(cubic, 0.5F * linear) : std::max(cubic, 0.5F * linear);
}

/// Fills the planes between slices k and k + 1.
class GapPlanes {
 public:
  GapPlanes(const DenseField& slices, int k, double rounding)
      : k_(k),
        before_(slices.row(0, std::max(k - 1, 0))),
        lower_(slices.row(0, k)),
        upper_(slices.row(0, k + 1)),
        after_(slices.row(0, std::min(k + 2, slices.size.z() - 1))),
        gap_(lower_, upper_, slices.size.x(), slices.size.y()) {
    gap_.balance(before_, after_, rounding);
  }

  void fill(double position, float limit, float* plane) const {
    const auto t = static_cast<float>(position - k_);
    const CubicWeights cubic = cubicWeights(position - k_);
    std::array<float, 4> w;
    for (std::size_t s = 0; s < 4; ++s) w[s] = static_cast<float>(cubic.value[s]);
    for (std::size_t p = 0; p < gap_.lower.size(); ++p) {
      const float b = gap_.lower[p], c = gap_.upper[p];
      float value = b + t * (c - b);
      if (gap_.limited[p])
        value -= gap_.bulge.empty() ? 0 : 4 * t * (1 - t) * gap_.bulge[p];
      else
        value =
            keepSign(w[0] * before_[p] + w[1] * lower_[p] + w[2] * upper_[p] + w[3] * after_[p], value, b, c);
      plane[p] = std::clamp(value, -limit, limit);
    }
  }

 private:
  int k_;
  const float *before_, *lower_, *upper_, *after_;
  SliceGap gap_;
};

}  // namespace

DenseField interpolateSlices(const DenseField& slices, double sliceSpacing,
                             const std::vector<double>& positions, double limit) {
  checkPositions(slices, positions);
  DenseField result({slices.size.x(), slices.size.y(), static_cast<int>(positions.size())});
  const int gaps = slices.size.z() - 1;
  tbb::parallel_for(0, gaps, [&](int k) {
    const auto first = std::lower_bound(positions.begin(), positions.end(), k);
    const auto last = k + 1 == gaps ? positions.end() : std::lower_bound(first, positions.end(), k + 1);
    if (first == last) return;
    const GapPlanes planes(slices, k, sliceSpacing);
    for (auto at = first; at != last; ++at)
      planes.fill(*at, static_cast<float>(limit), result.row(0, static_cast<int>(at - positions.begin())));
  });
  return result;
}

}  // namespace sinew
