#include "sinew/LevelSet/GaussianSmoothing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

constexpr double kRadiusSigmas = 3.5;

/// Weights w[0..radius] of the symmetric kernel w[|r|].
std::vector<float> kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(kRadiusSigmas * sigma));
  std::vector<double> weights(static_cast<std::size_t>(radius) + 1);
  double sum = 0;
  for (int r = 0; r <= radius; ++r) {
    weights[r] = std::exp(-(static_cast<double>(r) * r) / (2 * sigma * sigma));
    sum += (r == 0 ? 1 : 2) * weights[r];
  }
  std::vector<float> normalized;
  for (const double w : weights) normalized.push_back(static_cast<float>(w / sum));
  return normalized;
}

/// out[x] = sum_r w_r (lines[-r][x] + lines[r][x]): one row of the result from rows of the input.
template <typename Line>
void accumulate(const std::vector<float>& w, const Line& line, int n, float* out) {
  const float* centre = line(0);
  for (int x = 0; x < n; ++x) out[x] = w[0] * centre[x];
  for (int r = 1; r < static_cast<int>(w.size()); ++r) {
    const float* before = line(-r);
    const float* after = line(r);
    for (int x = 0; x < n; ++x) out[x] += w[r] * (before[x] + after[x]);
  }
}

void smoothAlongX(DenseField& field, const std::vector<float>& w) {
  const int n = field.size.x(), radius = static_cast<int>(w.size()) - 1;
  tbb::parallel_for(0, field.size.z(), [&](int k) {
    std::vector<float> padded(static_cast<std::size_t>(n + 2 * radius));
    for (int j = 0; j < field.size.y(); ++j) {
      float* row = field.row(j, k);
      std::fill_n(padded.begin(), radius, row[0]);
      std::copy_n(row, n, padded.begin() + radius);
      std::fill_n(padded.begin() + radius + n, radius, row[n - 1]);
      accumulate(
          w, [&](int r) { return padded.data() + radius + r; }, n, row);
    }
  });
}

/// Smooths a plane of rows: row(s) is the plane's row s, 0 <= s < n.
template <typename Row>
void smoothAcrossRows(const std::vector<float>& w, int n, int width, const Row& row) {
  std::vector<float> copy(static_cast<std::size_t>(n) * static_cast<std::size_t>(width));
  for (int s = 0; s < n; ++s) std::copy_n(row(s), width, copy.begin() + std::ptrdiff_t{s} * width);
  for (int s = 0; s < n; ++s) {
    const auto line = [&](int r) {
      return copy.data() + std::ptrdiff_t{std::clamp(s + r, 0, n - 1)} * width;
    };
    accumulate(w, line, width, row(s));
  }
}

}  // namespace

void gaussianSmoothing(DenseField& field, const Eigen::Vector3d& sigmaVoxels) {
  if (!(sigmaVoxels.array() >= 0).all())
    throw std::invalid_argument("gaussianSmoothing: sigmaVoxels must not be negative");
  const int nx = field.size.x(), ny = field.size.y(), nz = field.size.z();
  if (field.values.empty()) return;
  if (sigmaVoxels.x() > 0) smoothAlongX(field, kernel(sigmaVoxels.x()));
  if (sigmaVoxels.y() > 0) {
    const std::vector<float> w = kernel(sigmaVoxels.y());
    tbb::parallel_for(0, nz,
                      [&](int k) { smoothAcrossRows(w, ny, nx, [&](int j) { return field.row(j, k); }); });
  }
  if (sigmaVoxels.z() > 0) {
    const std::vector<float> w = kernel(sigmaVoxels.z());
    tbb::parallel_for(0, ny,
                      [&](int j) { smoothAcrossRows(w, nz, nx, [&](int k) { return field.row(j, k); }); });
  }
}

DenseField gaussianSmoothing(const DenseMask& mask, const Eigen::Vector3d& sigmaVoxels) {
  DenseField field(mask.size);
  std::copy(mask.values.begin(), mask.values.end(), field.values.begin());
  gaussianSmoothing(field, sigmaVoxels);
  return field;
}

}  // namespace sinew
