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
/// Empty when it does not settle within two samples of x0.
std::optional<double> closestPointDistance(const DenseField& phi, const Eigen::Vector3i& at,
                                           const Eigen::Vector3d& spacing) {
  constexpr int kSteps = 12;
  constexpr double kSettled = 1e-4, kReach = 2;  // voxels
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
    if ((x - x0).cwiseAbs().maxCoeff() > kReach) return std::nullopt;
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
/// farther away belongs to another sheet or to a stray root.
double seedDistance(const DenseField& phi, const Eigen::Vector3i& at, const Eigen::Vector3d& spacing) {
  constexpr double kBeyondCrossing = 1.5;
  const double crossing = crossingDistance(phi, at, spacing);
  const double closest = closestPointDistance(phi, at, spacing).value_or(crossing);
  return closest > kBeyondCrossing * crossing ? crossing : closest;
}

}  // namespace

std::vector<std::vector<SurfaceSeed>> surfaceSeeds(const DenseField& phi, const Eigen::Vector3d& spacing) {
  const double leastInside = 1e-6 * spacing.minCoeff();  // zero would be outside
  std::vector<std::vector<SurfaceSeed>> seeds(static_cast<std::size_t>(phi.size.z()));
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    std::vector<std::uint8_t> beside(static_cast<std::size_t>(phi.size.x()));
    for (int j = 0; j < phi.size.y(); ++j) {
      markBesideSurface(phi, j, k, beside);
      for (auto mark = beside.begin(); (mark = std::find(mark, beside.end(), 1)) != beside.end(); ++mark) {
        const int i = static_cast<int>(mark - beside.begin());
        const double distance = seedDistance(phi, {i, j, k}, spacing);
        const double value = phi(i, j, k) < 0 ? -std::max(distance, leastInside) : distance;
        seeds[static_cast<std::size_t>(k)].push_back({i, j, static_cast<float>(value)});
      }
    }
  });
  return seeds;
}

}  // namespace sinew
