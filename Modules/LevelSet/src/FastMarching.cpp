#include "sinew/LevelSet/FastMarching.h"

#include "Tricubic.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sinew {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();
constexpr double kBucketsPerVoxel = 64;

struct Seed {
  std::uint32_t index;
  float distance;  ///< signed, mm
};

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

/// Closest point of the tricubic zero set by Chopp's two-part Newton step, x in index units:
///     x += -P grad P / |grad P|^2 + (I - n n^T)(x0 - x),  n = grad P / |grad P|
/// Empty when it does not settle within two samples of x0.
std::optional<double> closestPointDistance(const DenseField& phi, const Eigen::Vector3d& x0,
                                           const Eigen::Vector3d& spacing) {
  constexpr int kSteps = 12;
  constexpr double kSettled = 1e-4, kReach = 2;  // voxels
  Eigen::Vector3d x = x0;
  for (int step = 0; step < kSteps; ++step) {
    const TricubicSample p = tricubicSample(phi, x);
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
  }
  return std::nullopt;
}

bool besideSurface(const DenseField& phi, int i, int j, int k) {
  const float* here = phi.row(j, k) + i;
  const std::ptrdiff_t dy = phi.size.x(), dz = dy * phi.size.y();
  const bool inside = *here < 0;
  const auto other = [&](std::ptrdiff_t step) { return (here[step] < 0) != inside; };
  return (i > 0 && other(-1)) || (i + 1 < phi.size.x() && other(1)) || (j > 0 && other(-dy)) ||
         (j + 1 < phi.size.y() && other(dy)) || (k > 0 && other(-dz)) || (k + 1 < phi.size.z() && other(dz));
}

std::vector<std::vector<Seed>> seedsBySlice(const DenseField& phi, const Eigen::Vector3d& spacing) {
  std::vector<std::vector<Seed>> seeds(static_cast<std::size_t>(phi.size.z()));
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    for (int j = 0; j < phi.size.y(); ++j)
      for (int i = 0; i < phi.size.x(); ++i) {
        if (!besideSurface(phi, i, j, k)) continue;
        const Eigen::Vector3i at(i, j, k);
        const double crossing = crossingDistance(phi, at, spacing);
        // The crossing bounds the distance from above up to the curvature within a voxel: a closest point
        // much farther away belongs to another sheet or to a stray root.
        const double distance = closestPointDistance(phi, at.cast<double>(), spacing).value_or(crossing);
        const double accepted = distance > 1.5 * crossing ? crossing : distance;
        const double leastInside = 1e-6 * spacing.minCoeff();  // zero would be outside
        seeds[static_cast<std::size_t>(k)].push_back(
            {static_cast<std::uint32_t>(phi.index(i, j, k)),
             static_cast<float>(phi(i, j, k) < 0 ? -std::max(accepted, leastInside) : accepted)});
      }
  });
  return seeds;
}

/// Samples to be accepted, nearest first up to the width of a bucket, within it in the order they came. A
/// heap's exact order takes half as long again and is no more accurate. Source: Yatziv, Bartesaghi, Sapiro
/// 2006 (untidy priority queue).
class BucketQueue {
 public:
  struct Entry {
    float distance;
    std::uint32_t index;
  };

  explicit BucketQueue(double width) : perLength_(static_cast<float>(1 / width)) {}

  void push(float distance, std::uint32_t index) {
    // Second-order differences may give a little less than the distance they came from: never go back.
    const std::size_t bucket = std::max(static_cast<std::size_t>(distance * perLength_), current_);
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    buckets_[bucket].push_back({distance, index});
  }

  std::optional<Entry> pop() {
    for (; current_ < buckets_.size(); ++current_, next_ = 0) {
      if (next_ < buckets_[current_].size()) return buckets_[current_][next_++];
      buckets_[current_] = {};
    }
    return std::nullopt;
  }

 private:
  float perLength_;
  std::size_t current_ = 0, next_ = 0;
  std::vector<std::vector<Entry>> buckets_;
};

/// One side of the surface. The other side is marched at the same time: of its samples only the sign is read,
/// which never changes, hence the relaxed atomic access.
class March {
 public:
  March(DenseField& phi, const Eigen::Vector3d& spacing, double band, bool inside)
      : phi_(phi),
        band_(static_cast<float>(band)),
        inside_(inside),
        stride_{1, phi.size.x(), std::ptrdiff_t{phi.size.x()} * phi.size.y()},
        queue_(spacing.minCoeff() / kBucketsPerVoxel) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double h = spacing[static_cast<Eigen::Index>(a)];
      inverseSquare_[a] = static_cast<float>(1 / (h * h));
      last_[a] = phi.size[static_cast<Eigen::Index>(a)] - 1;
    }
  }

  void run(const std::vector<std::vector<Seed>>& seeds) {
    for (const std::vector<Seed>& slice : seeds) {
      for (const Seed& seed : slice) {
        if (std::signbit(seed.distance) != inside_) continue;
        const float distance = std::abs(seed.distance);
        farthestSeed_ = std::max(farthestSeed_, distance);
        queue_.push(distance, seed.index);
      }
    }
    while (const std::optional<BucketQueue::Entry> next = queue_.pop())
      if (next->distance == std::abs(load(next->index))) accept(next->index, next->distance);
  }

 private:
  using Coordinates = std::array<int, 3>;
  Coordinates coordinates(std::uint32_t index) const {
    const auto nx = static_cast<std::uint32_t>(last_[0] + 1), ny = static_cast<std::uint32_t>(last_[1] + 1);
    const std::uint32_t row = index / nx;
    return {static_cast<int>(index % nx), static_cast<int>(row % ny), static_cast<int>(row / ny)};
  }

  float load(std::size_t index) const {
    return std::atomic_ref<float>(phi_.values[index]).load(std::memory_order_relaxed);
  }
  void store(std::size_t index, float distance) {
    std::atomic_ref<float>(phi_.values[index])
        .store(inside_ ? -distance : distance, std::memory_order_relaxed);
  }

  void accept(std::uint32_t from, float distance) {
    const Coordinates at = coordinates(from);
    for (std::size_t a = 0; a < 3; ++a) {
      for (const int side : {-1, 1}) {
        Coordinates neighbour = at;
        neighbour[a] += side;
        if (neighbour[a] < 0 || neighbour[a] > last_[a]) continue;
        relax(neighbour, static_cast<std::size_t>(from + side * stride_[a]), distance);
      }
    }
  }

  void relax(const Coordinates& at, std::size_t index, float reached) {
    const float value = load(index), known = std::abs(value);
    if (std::signbit(value) != inside_ || known <= reached) return;
    if (known <= farthestSeed_ && isSeed(at, index)) return;
    const float distance = upwindSolution(at, index, reached);
    if (distance >= known || distance > band_) return;
    store(index, distance);
    queue_.push(distance, static_cast<std::uint32_t>(index));
  }

  bool isSeed(const Coordinates& at, std::size_t index) const {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto step = static_cast<std::size_t>(stride_[a]);
      if (at[a] > 0 && std::signbit(load(index - step)) != inside_) return true;
      if (at[a] < last_[a] && std::signbit(load(index + step)) != inside_) return true;
    }
    return false;
  }

  /// Distance of the sample `steps` along an axis when the march has passed it, else kFar.
  float passed(const Coordinates& at, std::size_t index, std::size_t axis, int steps, float reached) const {
    const int c = at[axis] + steps;
    if (c < 0 || c > last_[axis]) return kFar;
    const float value = load(index + static_cast<std::size_t>(steps * stride_[axis]));
    const float distance = std::abs(value);
    return std::signbit(value) == inside_ && distance <= reached ? distance : kFar;
  }

  struct Term {
    float nearest;  ///< the passed neighbour; kFar where there is none
    float upwind;   ///< what the one-sided difference is taken from
    float weight;   ///< 1/h^2, or 9/(4 h^2) for second order
  };

  Term upwindTerm(const Coordinates& at, std::size_t index, std::size_t axis, float reached) const {
    const float before = passed(at, index, axis, -1, reached), after = passed(at, index, axis, 1, reached);
    const float nearest = std::min(before, after);
    if (nearest == kFar) return {kFar, kFar, 0};
    const float second = passed(at, index, axis, before <= after ? -2 : 2, reached);
    // d phi/dx = (3 phi - 4 phi_1 + phi_2) / (2h) = (3/(2h)) (phi - (4 phi_1 - phi_2)/3)
    if (second <= nearest) return {nearest, (4 * nearest - second) / 3, 2.25F * inverseSquare_[axis]};
    return {nearest, nearest, inverseSquare_[axis]};
  }

  /// Solves sum_a weight_a (phi - upwind_a)^2 = 1, leaving out the farthest axis while phi is not beyond it.
  float upwindSolution(const Coordinates& at, std::size_t index, float reached) const {
    std::array<Term, 3> terms;
    for (std::size_t a = 0; a < 3; ++a) terms[a] = upwindTerm(at, index, a, reached);
    if (terms[0].nearest > terms[1].nearest) std::swap(terms[0], terms[1]);
    if (terms[1].nearest > terms[2].nearest) std::swap(terms[1], terms[2]);
    if (terms[0].nearest > terms[1].nearest) std::swap(terms[0], terms[1]);
    // a phi^2 - 2 b phi + c = 0, one axis after the other, nearest first
    double a = 0, b = 0, c = -1, phi = kFar;
    for (const Term& term : terms) {
      if (term.nearest >= phi) break;
      const double w = term.weight, u = term.upwind;
      a += w;
      b += w * u;
      c += w * u * u;
      const double root = b * b - a * c;
      if (root < 0) break;
      phi = (b + std::sqrt(root)) / a;
    }
    return static_cast<float>(phi);
  }

  DenseField& phi_;
  float band_;
  bool inside_;
  float farthestSeed_ = 0;
  std::array<float, 3> inverseSquare_;
  std::array<int, 3> last_;
  std::array<std::ptrdiff_t, 3> stride_;
  BucketQueue queue_;
};

}  // namespace

void fastMarching(DenseField& phi, const Eigen::Vector3d& spacing, double band) {
  if (!(spacing.array() > 0).all() || !(band > 0))
    throw std::invalid_argument("fastMarching: spacing and band must be positive");
  if (phi.values.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("fastMarching: more than 2^32 samples");
  const std::vector<std::vector<Seed>> seeds = seedsBySlice(phi, spacing);
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    float* slice = phi.row(0, k);
    const std::size_t samples = phi.index(0, 0, 1);
    for (std::size_t s = 0; s < samples; ++s) slice[s] = slice[s] < 0 ? -kFar : kFar;
    for (const Seed& seed : seeds[static_cast<std::size_t>(k)]) phi.values[seed.index] = seed.distance;
  });
  tbb::parallel_invoke([&] { March(phi, spacing, band, true).run(seeds); },
                       [&] { March(phi, spacing, band, false).run(seeds); });
  const auto limit = static_cast<float>(band);
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    float* slice = phi.row(0, k);
    const std::size_t samples = phi.index(0, 0, 1);
    for (std::size_t s = 0; s < samples; ++s) slice[s] = std::clamp(slice[s], -limit, limit);
  });
}

}  // namespace sinew
