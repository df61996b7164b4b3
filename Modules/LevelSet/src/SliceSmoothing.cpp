#include "sinew/LevelSet/SliceSmoothing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

/// 1 below `full`, 0 above `none`, straight between.
float fade(float x, float full, float none) { return std::clamp((none - x) / (none - full), 0.0F, 1.0F); }

/// A step and how much it counts, blurred over the slice together.
struct WeightedSteps {
  std::vector<float> step, weight;  ///< step is already multiplied by the weight
};

class Smoother {
 public:
  Smoother(DenseField& slices, double pixel, double tolerancePixels)
      : slices_(slices),
        pixel_(static_cast<float>(pixel)),
        tolerance_(static_cast<float>(tolerancePixels * pixel)) {}

  void pass() {
    DenseField steps(slices_.size);
    tbb::parallel_for(1, slices_.size.z() - 1, [&](int k) { fillSteps(k, steps.row(0, k)); });
    tbb::parallel_for(1, slices_.size.z() - 1, [&](int k) {
      float* slice = slices_.row(0, k);
      const float* step = steps.row(0, k);
      for (std::size_t p = 0; p < slices_.index(0, 0, 1); ++p) slice[p] += step[p];
    });
  }

 private:
  /// The weighted mean of the steps around every pixel, so that neighbours on a contour move alike.
  void fillSteps(int k, float* result) const {
    constexpr float kFewWeights = 0.15F;  // below it the mean fades out
    const int nx = slices_.size.x(), ny = slices_.size.y();
    WeightedSteps sums;
    sums.step.assign(slices_.index(0, 0, 1), 0);
    sums.weight.assign(slices_.index(0, 0, 1), 0);
    int first = ny, last = -1;
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        if (!addStep(i, j, k, sums)) continue;
        first = std::min(first, j);
        last = j;
      }
    }
    if (last < 0) return;
    first = std::max(first - 2, 0);
    last = std::min(last + 2, ny - 1);
    blur(sums.step, first, last);
    blur(sums.weight, first, last);
    for (std::size_t p = slices_.index(0, first, 0); p < slices_.index(0, last + 1, 0); ++p)
      if (sums.weight[p] > 0) result[p] = sums.step[p] / std::max(sums.weight[p], kFewWeights);
  }

  bool addStep(int i, int j, int k, WeightedSteps& sums) const {
    constexpr float kBeside = 1.5F, kFollows = 3;  // pixels
    const float here = slices_(i, j, k);
    if (std::abs(here) > kBeside * pixel_) return false;
    const float below = slices_(i, j, k - 1), above = slices_(i, j, k + 1);
    if (std::max(std::abs(below), std::abs(above)) > kFollows * pixel_) return false;
    const float step = 0.25F * (below - 2 * here + above);
    const float weight = fade(std::abs(here), 0.5F * kBeside * pixel_, kBeside * pixel_) * thickness(i, j, k);
    const std::size_t p = slices_.index(i, j, 0);
    sums.step[p] = weight * step * fade(std::abs(step), tolerance_, 2 * tolerance_);
    sums.weight[p] = weight;
    return weight > 0;
  }

  /// 1 where tissue and background are both at least two pixels deep three pixels away, 0 below one and a
  /// half.
  float thickness(int i, int j, int k) const {
    constexpr std::array<std::array<int, 2>, 8> kRing{
        {{3, 0}, {2, 2}, {0, 3}, {-2, 2}, {-3, 0}, {-2, -2}, {0, -3}, {2, -2}}};
    float lowest = 0, highest = 0;
    for (const auto& [dx, dy] : kRing) {
      const int x = std::clamp(i + dx, 0, slices_.size.x() - 1),
                y = std::clamp(j + dy, 0, slices_.size.y() - 1);
      lowest = std::min(lowest, slices_(x, y, k));
      highest = std::max(highest, slices_(x, y, k));
    }
    return 1 - fade(std::min(-lowest, highest), 1.5F * pixel_, 2 * pixel_);
  }

  /// (1 4 6 4 1)/16 along both axes, rows first..last; zero beyond the slice.
  void blur(std::vector<float>& values, int first, int last) const {
    constexpr std::array<float, 5> kBinomial{1 / 16.0F, 4 / 16.0F, 6 / 16.0F, 4 / 16.0F, 1 / 16.0F};
    const int nx = slices_.size.x();
    std::vector<float> padded(static_cast<std::size_t>(nx) + 4, 0), above(values.size(), 0);
    for (int j = first; j <= last; ++j) {
      float* row = values.data() + slices_.index(0, j, 0);
      std::copy_n(row, nx, padded.begin() + 2);
      for (int i = 0; i < nx; ++i) {
        row[i] = 0;
        for (std::size_t s = 0; s < 5; ++s) row[i] += kBinomial[s] * padded[static_cast<std::size_t>(i) + s];
      }
    }
    for (int j = first; j <= last; ++j) {
      float* out = above.data() + slices_.index(0, j, 0);
      for (int s = -2; s <= 2; ++s) {
        if (j + s < first || j + s > last) continue;
        const float weight = kBinomial[static_cast<std::size_t>(s + 2)];
        const float* in = values.data() + slices_.index(0, j + s, 0);
        for (int i = 0; i < nx; ++i) out[i] += weight * in[i];
      }
    }
    values.swap(above);
  }

  DenseField& slices_;
  float pixel_, tolerance_;
};

}  // namespace

void smoothAcrossSlices(DenseField& slices, double pixel, const SliceSmoothingOptions& options) {
  if (!(pixel > 0) || options.passes < 0 || !(options.tolerancePixels > 0))
    throw std::invalid_argument(
        "smoothAcrossSlices: pixel and tolerance must be positive, passes not negative");
  Smoother smoother(slices, pixel, options.tolerancePixels);
  for (int pass = 0; pass < options.passes; ++pass) smoother.pass();
}

}  // namespace sinew
