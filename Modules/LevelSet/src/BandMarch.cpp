#include "BandMarch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace sinew {
namespace {

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

/// One side after the other would give the same: a sample only looks at samples of its own sign.
class March {
 public:
  March(DenseField& phi, const Eigen::Vector3d& spacing, double band, const BandMarchOptions& options)
      : phi_(phi.values.data()),
        samples_(phi.values.size()),
        options_(options),
        band_(static_cast<float>(band)),
        stride_{1, phi.size.x(), std::ptrdiff_t{phi.size.x()} * phi.size.y()},
        queue_(spacing.minCoeff() / kBucketsPerVoxel) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double h = spacing[static_cast<Eigen::Index>(a)];
      inverseSquare_[a] = static_cast<float>(1 / (h * h));
    }
  }

  void run(const std::vector<std::uint32_t>& seeds) {
    if (options_.keepWithin > 0) kept_.resize(samples_);
    for (const std::uint32_t seed : seeds) {
      if (!kept_.empty()) kept_[seed] = 1;
      const float distance = std::abs(phi_[seed]);
      if (options_.fixBeside) farthestFixed_ = std::max(farthestFixed_, distance);
      queue_.push(distance, seed);
    }
    while (const std::optional<BucketQueue::Entry> next = queue_.pop())
      if (next->distance == std::abs(phi_[next->index])) accept(next->index, next->distance);
  }

 private:
  static constexpr double kBucketsPerVoxel = 64;

  void accept(std::uint32_t from, float distance) {
    const bool inside = std::signbit(phi_[from]);
    for (const std::ptrdiff_t stride : stride_) {
      relax(from - stride, inside, distance);
      relax(from + stride, inside, distance);
    }
  }

  void relax(std::ptrdiff_t at, bool inside, float reached) {
    const float known = std::abs(phi_[at]);
    if (!(known > reached) || std::signbit(phi_[at]) != inside) return;  // also kNowhere
    if (known <= farthestFixed_ && isBeside(at)) return;
    const float distance = upwindSolution(at, inside, reached);
    if (distance >= known || distance > band_) return;
    if (!kept_.empty() && kept_[static_cast<std::size_t>(at)] != 0 && distance > known - options_.keepWithin)
      return;
    phi_[at] = inside ? -distance : distance;
    queue_.push(distance, static_cast<std::uint32_t>(at));
  }

  bool isBeside(std::ptrdiff_t at) const {
    const auto across = [&](float other) {
      return !std::isnan(other) && std::signbit(other) != std::signbit(phi_[at]);
    };
    return std::any_of(stride_.begin(), stride_.end(), [&](std::ptrdiff_t stride) {
      return across(phi_[at - stride]) || across(phi_[at + stride]);
    });
  }

  /// Distance of a sample on the same side that the march has passed, else kUnreached.
  float passed(std::ptrdiff_t at, bool inside, float reached) const {
    const float distance = std::abs(phi_[at]);
    return distance <= reached && std::signbit(phi_[at]) == inside ? distance : kUnreached;
  }

  struct Term {
    float nearest;  ///< the passed neighbour; kUnreached where there is none
    float upwind;   ///< what the one-sided difference is taken from
    float weight;   ///< 1/h^2, or 9/(4 h^2) for second order
  };

  Term upwindTerm(std::ptrdiff_t at, std::size_t axis, bool inside, float reached) const {
    const std::ptrdiff_t stride = stride_[axis];
    const float before = passed(at - stride, inside, reached), after = passed(at + stride, inside, reached);
    const float nearest = std::min(before, after);
    if (nearest == kUnreached) return {kUnreached, kUnreached, 0};
    if (options_.order == 1) return {nearest, nearest, inverseSquare_[axis]};
    const float second = passed(before <= after ? at - 2 * stride : at + 2 * stride, inside, reached);
    // d phi/dx = (3 phi - 4 phi_1 + phi_2) / (2h) = (3/(2h)) (phi - (4 phi_1 - phi_2)/3)
    if (second <= nearest) return {nearest, (4 * nearest - second) / 3, 2.25F * inverseSquare_[axis]};
    return {nearest, nearest, inverseSquare_[axis]};
  }

  /// Solves sum_a weight_a (phi - upwind_a)^2 = 1, leaving out the farthest axes while phi is not beyond
  /// them.
  float upwindSolution(std::ptrdiff_t at, bool inside, float reached) const {
    std::array<Term, 3> terms;
    for (std::size_t a = 0; a < 3; ++a) terms[a] = upwindTerm(at, a, inside, reached);
    if (terms[0].nearest > terms[1].nearest) std::swap(terms[0], terms[1]);
    if (terms[1].nearest > terms[2].nearest) std::swap(terms[1], terms[2]);
    if (terms[0].nearest > terms[1].nearest) std::swap(terms[0], terms[1]);
    // a phi^2 - 2 b phi + c = 0, one axis after the other, nearest first
    double a = 0, b = 0, c = -1, phi = kUnreached;
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

  float* phi_;
  std::size_t samples_;
  std::vector<std::uint8_t> kept_;  ///< 1 at the seeds; empty where none is kept
  BandMarchOptions options_;
  float band_;
  float farthestFixed_ = -1;
  std::array<float, 3> inverseSquare_;
  std::array<std::ptrdiff_t, 3> stride_;
  BucketQueue queue_;
};

}  // namespace

void bandMarch(DenseField& phi, const std::vector<std::uint32_t>& seeds, const Eigen::Vector3d& spacing,
               double band, const BandMarchOptions& options) {
  March(phi, spacing, band, options).run(seeds);
}

}  // namespace sinew
