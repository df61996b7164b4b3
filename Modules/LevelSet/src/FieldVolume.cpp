#include "sinew/LevelSet/FieldVolume.h"

#include "VoxelFraction.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

/// Part of the unit cube with m.x < alpha, for m1 <= m2 <= m3, m1 + m2 + m3 = 1, 0 <= alpha <= 1/2.
double cubeFraction(double m1, double m2, double m3, double alpha) {
  const double m12 = m1 + m2, m = std::min(m12, m3);
  const double six = 6 * m1 * m2 * m3;
  if (alpha < m1) return alpha * alpha * alpha / six;
  if (alpha < m2) return alpha * (alpha - m1) / (2 * m2 * m3) + m1 * m1 / std::max(6 * m2 * m3, 1e-50);
  if (alpha >= m && m12 <= m3) return (2 * alpha - m12) / (2 * m3);
  if (six < 1e-12)
    return alpha * alpha / (2 * m2 * m3) - (alpha > m3 ? (alpha - m3) * (alpha - m3) / (2 * m2 * m3) : 0) -
           (alpha > m2 ? (alpha - m2) * (alpha - m2) / (2 * m2 * m3) : 0);
  const auto corner = [&](double c) { return alpha > c ? (alpha - c) * (alpha - c) * (alpha - c) : 0.0; };
  return (alpha * alpha * alpha - corner(m1) - corner(m2) - corner(m3)) / six;
}

}  // namespace

double halfSpaceFraction(double distance, const Eigen::Vector3d& normal, const Eigen::Vector3d& edges) {
  std::array<double, 3> m;
  for (std::size_t a = 0; a < 3; ++a)
    m[a] = std::abs(normal[static_cast<Eigen::Index>(a)]) * edges[static_cast<Eigen::Index>(a)];
  const double sum = m[0] + m[1] + m[2];
  if (distance <= -sum / 2) return 1;
  if (distance >= sum / 2) return 0;
  std::sort(m.begin(), m.end());
  const double alpha = std::clamp(0.5 - distance / sum, 0.0, 1.0);
  const double half = cubeFraction(m[0] / sum, m[1] / sum, m[2] / sum, std::min(alpha, 1 - alpha));
  return alpha <= 0.5 ? half : 1 - half;
}

double voxelFraction(const PhiStencil& phi, const Eigen::Vector3d& spacing, double level) {
  Eigen::Vector3d gradient;
  double mean = phi.centre;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    gradient[axis] = (phi.after[a] - phi.before[a]) / (2 * spacing[axis]);
    mean += (phi.after[a] - 2 * phi.centre + phi.before[a]) / 24;
  }
  const double norm = gradient.norm();
  const Eigen::Vector3d normal = norm > 0 ? Eigen::Vector3d(gradient / norm) : Eigen::Vector3d::UnitX();
  return halfSpaceFraction(mean - level, normal, spacing);
}

double fieldVolume(const DenseField& phi, const Eigen::Vector3d& spacing, double level) {
  const Eigen::Vector3i last = phi.size - Eigen::Vector3i::Ones();
  const double reach = kCutReach * spacing.norm();
  const auto low = static_cast<float>(level - reach), high = static_cast<float>(level + reach);
  const auto sliceVolume = [&](int k) {
    double voxels = 0;
    const int below = std::max(k - 1, 0), above = std::min(k + 1, last.z());
    for (int j = 0; j < phi.size.y(); ++j) {
      const float* row = phi.row(j, k);
      const float *front = phi.row(std::max(j - 1, 0), k), *back = phi.row(std::min(j + 1, last.y()), k),
                  *down = phi.row(j, below), *up = phi.row(j, above);
      for (int i = 0; i < phi.size.x(); ++i) {
        if (row[i] >= high) continue;
        if (row[i] <= low) {
          voxels += 1;
          continue;
        }
        const PhiStencil stencil{row[i],
                                 {row[std::max(i - 1, 0)], front[i], down[i]},
                                 {row[std::min(i + 1, last.x())], back[i], up[i]}};
        voxels += voxelFraction(stencil, spacing, level);
      }
    }
    return voxels;
  };
  const double voxels = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<int>(0, phi.size.z(), 1), 0.0,
      [&](const tbb::blocked_range<int>& slices, double sum) {
        for (int k = slices.begin(); k < slices.end(); ++k) sum += sliceVolume(k);
        return sum;
      },
      std::plus<>());
  return voxels * spacing.prod();
}

double volumeKeepingLevel(const DenseField& phi, const Eigen::Vector3d& spacing, double volume, double lowest,
                          double highest) {
  constexpr int kSteps = 6;
  constexpr double kMet = 1e-5;
  double a = 0, missA = fieldVolume(phi, spacing, a) - volume;
  if (std::abs(missA) <= kMet * volume) return a;
  double best = a, leastMiss = std::abs(missA);
  // The first step takes the volume for a sphere's: dV = 4 pi R^2 dR; the secant corrects a wrong area.
  const double area = std::cbrt(36 * 3.14159265358979 * volume * volume);
  double b = std::clamp(-missA / area, lowest, highest);
  for (int step = 0; step < kSteps; ++step) {
    const double missB = fieldVolume(phi, spacing, b) - volume;
    if (std::abs(missB) < leastMiss) {
      best = b;
      leastMiss = std::abs(missB);
    }
    if (leastMiss <= kMet * volume || missA == missB) break;
    const double next = std::clamp(b - missB * (b - a) / (missB - missA), lowest, highest);
    a = b;
    missA = missB;
    b = next;
    if (a == b) break;
  }
  return best;
}

}  // namespace sinew
