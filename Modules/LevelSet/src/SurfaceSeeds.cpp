#include "SurfaceSeeds.h"

#include "Tricubic.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sinew {
namespace {

/// Distance to the zero set along the axes: 1/d^2 = sum 1/d_a^2, d_a the linear crossing towards neighbour a.
double crossingDistance(const DenseField& phi, const Eigen::Vector3i& at, const Eigen::Vector3d& spacing) {
  const double here = phi(at.x(), at.y(), at.z());
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int side : {-1, 1}) {
      const Eigen::Vector3i n = at + side * Eigen::Vector3i::Unit(a);
      if (n[a] < 0 || n[a] >= phi.size[a]) continue;
      const double there = phi(n.x(), n.y(), n.z());
      if ((here < 0) != (there < 0)) nearest = std::min(nearest, spacing[a] * here / (here - there));
    }
    if (nearest == 0) return 0;
    sum += 1 / (nearest * nearest);
  }
  return 1 / std::sqrt(sum);
}

/// The interpolant at a sample: there it is the sample, and central differences.
TricubicSample atSample(const DenseField& phi, const Eigen::Vector3i& at) {
  TricubicSample result;
  result.value = phi(at.x(), at.y(), at.z());
  for (int a = 0; a < 3; ++a) {
    Eigen::Vector3i before = at, after = at;
    before[a] = std::max(at[a] - 1, 0);
    after[a] = std::min(at[a] + 1, phi.size[a] - 1);
    result.gradient[a] =
        0.5 * (double{phi(after.x(), after.y(), after.z())} - phi(before.x(), before.y(), before.z()));
  }
  return result;
}

/// Distance to the closest point of the tricubic zero set by Chopp's two-part Newton step, x in index units:
///     x += -P grad P / |grad P|^2 + (I - n n^T)(x0 - x),  n = grad P / |grad P|
/// Empty when it does not settle within `reach` samples of x0.
std::optional<double> closestPointDistance(const DenseField& phi, const Eigen::Vector3i& at,
                                           const Eigen::Vector3d& spacing, double reach) {
  constexpr int kSteps = 12;
  constexpr double kSettled = 1e-4;  // voxels
  const Eigen::Vector3d x0 = at.cast<double>();
  Eigen::Vector3d x = x0;
  TricubicSample p = atSample(phi, at);
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector3d gradient = p.gradient.cwiseQuotient(spacing);  // per mm
    const double squared = gradient.squaredNorm();
    if (!(squared > 0)) return std::nullopt;
    const Eigen::Vector3d back = (x0 - x).cwiseProduct(spacing);  // mm
    const Eigen::Vector3d normal = (p.value / squared) * gradient;
    const Eigen::Vector3d tangent = back - (back.dot(gradient) / squared) * gradient;
    const Eigen::Vector3d move = (tangent - normal).cwiseQuotient(spacing);
    x += move;
    if ((x - x0).cwiseAbs().maxCoeff() > reach) return std::nullopt;
    if (move.cwiseAbs().maxCoeff() < kSettled) return (x - x0).cwiseProduct(spacing).norm();
    p = tricubicSample(phi, x);
  }
  return std::nullopt;
}

/// Marks the samples of a row that have a neighbour on the other side, neighbours beyond the raster apart.
void markBesideSurface(const DenseField& phi, int j, int k, std::vector<std::uint8_t>& beside) {
  const int nx = phi.size.x();
  const float *row = phi.row(j, k), *front = phi.row(std::max(j - 1, 0), k),
              *back = phi.row(std::min(j + 1, phi.size.y() - 1), k), *below = phi.row(j, std::max(k - 1, 0)),
              *above = phi.row(j, std::min(k + 1, phi.size.z() - 1));
  std::uint8_t* mark = beside.data();
  const auto other = [&](const float* neighbour, int i) { return (neighbour[i] < 0) != (row[i] < 0); };
  for (int i = 0; i < nx; ++i) mark[i] = other(front, i) | other(back, i) | other(below, i) | other(above, i);
  for (int i = 1; i < nx; ++i) mark[i] |= (row[i - 1] < 0) != (row[i] < 0);
  for (int i = 0; i + 1 < nx; ++i) mark[i] |= (row[i + 1] < 0) != (row[i] < 0);
}

/// The crossing bounds the distance from above up to the curvature within a voxel: a closest point much
/// farther away belongs to another sheet or to a stray root. Nothing when there is neither.
std::optional<double> seedDistance(const DenseField& phi, const Eigen::Vector3i& at,
                                   const Eigen::Vector3d& spacing, int layers) {
  constexpr double kBeyondCrossing = 1.5;
  const double crossing = crossingDistance(phi, at, spacing);
  const std::optional<double> closest = closestPointDistance(phi, at, spacing, layers + 1);
  if (std::isinf(crossing)) return closest;
  return closest && !(*closest > kBeyondCrossing * crossing) ? *closest : crossing;
}

using SliceSeeds = std::vector<SurfaceSeed>;

/// The samples beside the surface, distances left open.
std::vector<SliceSeeds> besideSurface(const DenseField& phi) {
  std::vector<SliceSeeds> seeds(static_cast<std::size_t>(phi.size.z()));
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    std::vector<std::uint8_t> beside(static_cast<std::size_t>(phi.size.x()));
    for (int j = 0; j < phi.size.y(); ++j) {
      markBesideSurface(phi, j, k, beside);
      for (auto mark = beside.begin(); (mark = std::find(mark, beside.end(), 1)) != beside.end(); ++mark)
        seeds[static_cast<std::size_t>(k)].push_back({static_cast<int>(mark - beside.begin()), j, 0});
    }
  });
  return seeds;
}

/// Those and the samples within `steps` along the axes.
std::vector<SliceSeeds> widened(const std::vector<SliceSeeds>& seeds, const Eigen::Vector3i& size,
                                int steps) {
  std::vector<SliceSeeds> result(seeds.size());
  tbb::parallel_for(0, size.z(), [&](int k) {
    DenseMask near({size.x(), size.y(), 1});
    for (int from = std::max(k - steps, 0); from <= std::min(k + steps, size.z() - 1); ++from)
      for (const SurfaceSeed& seed : seeds[static_cast<std::size_t>(from)])
        for (int dj = -steps; dj <= steps; ++dj)
          for (int di = -steps; di <= steps; ++di) {
            const int i = seed.i + di, j = seed.j + dj;
            if (std::abs(di) + std::abs(dj) + std::abs(k - from) > steps) continue;
            if (i >= 0 && i < size.x() && j >= 0 && j < size.y()) near(i, j, 0) = 1;
          }
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        if (near(i, j, 0) != 0) result[static_cast<std::size_t>(k)].push_back({i, j, 0});
  });
  return result;
}

}  // namespace

std::vector<SliceSeeds> surfaceSeeds(const DenseField& phi, const Eigen::Vector3d& spacing, int layers) {
  const double leastInside = 1e-6 * spacing.minCoeff();  // zero would be outside
  std::vector<SliceSeeds> seeds = besideSurface(phi);
  if (layers > 1) seeds = widened(seeds, phi.size, layers - 1);
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    std::erase_if(seeds[static_cast<std::size_t>(k)], [&](SurfaceSeed& seed) {
      const std::optional<double> distance = seedDistance(phi, {seed.i, seed.j, k}, spacing, layers);
      if (!distance) return true;
      const double value = phi(seed.i, seed.j, k) < 0 ? -std::max(*distance, leastInside) : *distance;
      seed.distance = static_cast<float>(value);
      return false;
    });
  });
  return seeds;
}

}  // namespace sinew
