#include "sinew/LevelSet/FastMarching.h"

#include "Tricubic.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <stdexcept>

namespace sinew {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();

struct Seed {
  std::size_t index;
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
            {phi.index(i, j, k),
             static_cast<float>(phi(i, j, k) < 0 ? -std::max(accepted, leastInside) : accepted)});
      }
  });
  return seeds;
}

/// One side of the surface. The other side is marched at the same time: of its samples only the sign is read,
/// which never changes, hence the relaxed atomic access.
class March {
 public:
  March(DenseField& phi, const Eigen::Vector3d& spacing, double band, bool inside)
      : phi_(phi), band_(static_cast<float>(band)), inside_(inside) {
    for (int a = 0; a < 3; ++a)
      inverseSquare_[static_cast<std::size_t>(a)] = static_cast<float>(1 / (spacing[a] * spacing[a]));
    stride_ = {1, phi.size.x(), std::ptrdiff_t{phi.size.x()} * phi.size.y()};
  }

  void run(const std::vector<std::vector<Seed>>& seeds) {
    for (const std::vector<Seed>& slice : seeds)
      for (const Seed& seed : slice)
        if (std::signbit(seed.distance) == inside_) heap_.push({std::abs(seed.distance), seed.index});
    while (!heap_.empty()) {
      const Entry next = heap_.top();
      heap_.pop();
      if (next.distance == std::abs(load(next.index))) accept(next);
    }
  }

 private:
  struct Entry {
    float distance;
    std::size_t index;
    bool operator<(const Entry& other) const {
      return distance != other.distance ? distance > other.distance : index > other.index;
    }
  };

  float load(std::size_t index) const {
    return std::atomic_ref<float>(phi_.values[index]).load(std::memory_order_relaxed);
  }
  void store(std::size_t index, float distance) {
    std::atomic_ref<float>(phi_.values[index])
        .store(inside_ ? -distance : distance, std::memory_order_relaxed);
  }
  std::array<int, 3> coordinates(std::size_t index) const {
    const auto nx = static_cast<std::size_t>(phi_.size.x()), ny = static_cast<std::size_t>(phi_.size.y());
    return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
            static_cast<int>(index / (nx * ny))};
  }

  void accept(const Entry& from) {
    const std::array<int, 3> at = coordinates(from.index);
    for (std::size_t a = 0; a < 3; ++a)
      for (const int side : {-1, 1}) {
        std::array<int, 3> neighbour = at;
        neighbour[a] += side;
        if (neighbour[a] < 0 || neighbour[a] >= phi_.size[static_cast<Eigen::Index>(a)]) continue;
        relax(neighbour, from.index + static_cast<std::size_t>(side * stride_[a]), from.distance);
      }
  }

  void relax(const std::array<int, 3>& at, std::size_t index, float reached) {
    const float value = load(index);
    if (std::signbit(value) != inside_ || std::abs(value) <= reached || isSeed(at, index)) return;
    const float distance = upwindSolution(at, index, reached);
    if (distance >= std::abs(value) || distance > band_) return;
    store(index, distance);
    heap_.push({distance, index});
  }

  bool isSeed(const std::array<int, 3>& at, std::size_t index) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (at[a] > 0 && std::signbit(load(index - static_cast<std::size_t>(stride_[a]))) != inside_)
        return true;
      if (at[a] + 1 < phi_.size[static_cast<Eigen::Index>(a)] &&
          std::signbit(load(index + static_cast<std::size_t>(stride_[a]))) != inside_)
        return true;
    }
    return false;
  }

  /// Distance of the sample `steps` along an axis when the march has passed it, else kFar.
  float passed(const std::array<int, 3>& at, std::size_t index, std::size_t axis, int steps,
               float reached) const {
    const int c = at[axis] + steps;
    if (c < 0 || c >= phi_.size[static_cast<Eigen::Index>(axis)]) return kFar;
    const float value = load(index + static_cast<std::size_t>(steps * stride_[axis]));
    if (std::signbit(value) != inside_) return kFar;
    const float distance = std::abs(value);
    return distance <= reached ? distance : kFar;
  }

  struct Term {
    float upwind = kFar;  ///< value that the one-sided difference is taken from
    float weight = 0;     ///< 1/h^2, or 9/(4 h^2) for second order
    float nearest = kFar;
  };

  Term upwindTerm(const std::array<int, 3>& at, std::size_t index, std::size_t axis, float reached) const {
    Term term;
    const float before = passed(at, index, axis, -1, reached), after = passed(at, index, axis, 1, reached);
    const int side = before <= after ? -1 : 1;
    term.nearest = std::min(before, after);
    if (term.nearest == kFar) return term;
    const float second = passed(at, index, axis, 2 * side, reached);
    const bool secondOrder = second <= term.nearest;
    // d phi/dx = (3 phi - 4 phi_1 + phi_2) / (2h) = (3/(2h)) (phi - (4 phi_1 - phi_2)/3)
    term.upwind = secondOrder ? (4 * term.nearest - second) / 3 : term.nearest;
    term.weight = inverseSquare_[axis] * (secondOrder ? 2.25F : 1.0F);
    return term;
  }

  /// Solves sum_a weight_a (phi - upwind_a)^2 = 1, leaving out the farthest axis while phi is not beyond it.
  float upwindSolution(const std::array<int, 3>& at, std::size_t index, float reached) const {
    std::array<Term, 3> terms;
    for (std::size_t a = 0; a < 3; ++a) terms[a] = upwindTerm(at, index, a, reached);
    std::sort(terms.begin(), terms.end(), [](const Term& s, const Term& t) { return s.nearest < t.nearest; });
    for (std::size_t used = 3; used > 0; --used) {
      if (terms[used - 1].nearest == kFar) continue;
      double a = 0, b = 0, c = -1;
      for (std::size_t t = 0; t < used; ++t) {
        const double w = terms[t].weight, u = terms[t].upwind;
        a += w;
        b += w * u;
        c += w * u * u;
      }
      const double root = b * b - a * c;
      if (root < 0) continue;
      const double phi = (b + std::sqrt(root)) / a;
      if (phi >= terms[used - 1].nearest) return static_cast<float>(phi);
    }
    return kFar;
  }

  DenseField& phi_;
  float band_;
  bool inside_;
  std::array<float, 3> inverseSquare_;
  std::array<std::ptrdiff_t, 3> stride_;
  std::priority_queue<Entry> heap_;
};

}  // namespace

void fastMarching(DenseField& phi, const Eigen::Vector3d& spacing, double band) {
  if (!(spacing.array() > 0).all() || !(band > 0))
    throw std::invalid_argument("fastMarching: spacing and band must be positive");
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
