#include "sinew/Mesher/Compression.h"

#include "ActiveNodes.h"
#include "GoalMeasure.h"
#include "GoalStar.h"
#include "NodeStarEnergy.h"
#include "Parallel.h"
#include "SurfaceProjection.h"

#include <Eigen/Dense>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNodeGrain = 8;  // nodes per task, at least: a patch of the repair has few of a colour
constexpr double kFirstCap = 6;    // F that the first snap may cost
constexpr double kLastCap = 14;
constexpr double kCapGrowth = 1.4;  // per round
constexpr double kStill = 0.002;    // edge lengths: a smaller step does not stir the neighbours
constexpr int kFullRounds = 3;      // rounds after which only the surroundings of late nodes go on
constexpr int kLateRings = 2;

/// One stretch of smooth descent: sweeps on the sum of F^q over the nodes whose worst F is above a threshold.
/// With low q it serves the mean; a step may then not raise the worst F of its star above the ceiling.
struct Descent {
  int sweeps;
  int q;
  double threshold = 0;
  double ceiling = kInfinity;
};
constexpr Descent kSettle{1, 2};
constexpr std::array<Descent, 4> kPolish{{{1, 4}, {3, 8, 1.5}, {3, 16, 2.0}, {1, 1, 0, 1.6}}};

/// One stretch of the last descent: on the sum of m^power over the stars of the nodes of tets with m > above.
struct Finish {
  int sweeps;
  int power;
  double above;
  double decisive;              ///< tets below this part of the star's worst m do not count in the gradient
  double hopeless = kInfinity;  ///< stars with a worse m are left alone
};
/// The higher power takes stars over the line that are near it; it would only spread what is bad elsewhere.
constexpr std::array<Finish, 2> kFinish{{{12, 16, 1.02, 0.7}, {8, 64, 0.985, 0.9, 1.1}}};

class StarCompressor {
 public:
  StarCompressor(TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& options,
                 const std::vector<std::uint8_t>& region)
      : mesh_(mesh),
        phi_(phi),
        options_(options),
        active_(activeNodes(mesh, region.empty() ? movableNodes(mesh) : region)),
        tolerance_(options.surfaceTolerance * options.edgeLength),
        project_(phi, 0.5 * tolerance_),
        level_(active_.size(), 0.0),
        stirred_(active_.size(), 1),
        awake_(active_.size(), 1) {
    forEach(active_.size(), [&](std::size_t n) {
      if (!isBoundary(n)) return;
      const double level = phi.value(position(n));
      if (std::abs(level) > tolerance_) level_[n] = level;
    });
  }

  CompressionReport run() {
    CompressionReport report;
    double cap = kFirstCap;
    wakeAround(unsnapped());
    for (; report.snapSweeps < options_.snapSweeps;
         ++report.snapSweeps, cap = std::min(kLastCap, cap * kCapGrowth)) {
      snap(cap);
      descend(kSettle);
      const std::vector<std::int32_t> late = unsnapped();
      if (late.empty()) break;
      if (report.snapSweeps + 1 >= kFullRounds) wakeAround(late);
    }
    std::fill(awake_.begin(), awake_.end(), std::uint8_t{1});
    for (const Descent& descent : kPolish) {
      stirAbove(descent.threshold);
      descend(descent);
    }
    for (const Finish& stretch : kFinish) finish(stretch);
    for (const std::int32_t n : unsnapped()) report.unsnapped.push_back(active_.nodes[n]);
    std::ranges::sort(report.unsnapped);
    return report;
  }

 private:
  bool isBoundary(std::size_t n) const { return mesh_.kinds[active_.nodes[n]] == NodeKind::Boundary; }
  Vector3d& position(std::size_t n) { return mesh_.nodes[active_.nodes[n]]; }

  std::vector<std::int32_t> unsnapped() const {
    return collect<std::int32_t>(level_.size(), [&](std::size_t n, auto& list) {
      if (level_[n] != 0) list.push_back(static_cast<std::int32_t>(n));
    });
  }

  /// Puts all nodes to sleep but those within a few rings of the given ones.
  void wakeAround(std::vector<std::int32_t> nodes) {
    std::fill(awake_.begin(), awake_.end(), std::uint8_t{0});
    for (const std::int32_t n : nodes) awake_[n] = 1;
    for (int ring = 0; ring < kLateRings; ++ring) {
      const std::size_t before = nodes.size();
      for (std::size_t k = 0; k < before; ++k) {
        for (const StarFaceNodes& face : active_.star(nodes[k])) {
          for (const std::int32_t v : face) {
            const std::int32_t other = active_.indexOf[v];
            if (other < 0 || awake_[other] != 0) continue;
            awake_[other] = 1;
            nodes.push_back(other);
          }
        }
      }
    }
  }

  /// Calls move(n, star) for the awake nodes, colour by colour; the star is empty until it is gathered.
  template <class Star, class Move>
  void forEachNode(const Move& move) {
    for (const auto& [begin, end] : active_.colors) {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, kNodeGrain), [&](const auto& range) {
        Star star;
        for (std::size_t n = range.begin(); n < range.end(); ++n) {
          if (awake_[n] != 0) move(static_cast<std::int32_t>(n), star);
        }
      });
    }
  }

  void gather(std::int32_t n, NodeStar& star) { star.gather(active_.star(n), mesh_.nodes, position(n)); }

  /// Moves boundary nodes towards phi = 0 as far as the cap on F allows.
  void snap(double cap) {
    forEachNode<NodeStar>([&](std::int32_t n, NodeStar& star) {
      if (!isBoundary(n) || level_[n] == 0) return;
      gather(n, star);
      for (const double fraction : {1.0, 0.6, 0.3, 0.1}) {
        const double level = fraction == 1.0 ? 0.0 : (1 - fraction) * level_[n];
        const std::optional<Vector3d> target = project_(position(n), level);
        if (!target || star.value(*target, 1).worst > cap) continue;
        moveTo(n, *target);
        level_[n] = level;
        return;
      }
    });
  }

  /// Marks the nodes of all tets whose F is above a threshold as stirred, and no others.
  void stirAbove(double threshold) {
    if (threshold <= 1) {
      std::fill(stirred_.begin(), stirred_.end(), std::uint8_t{1});
      return;
    }
    std::fill(stirred_.begin(), stirred_.end(), std::uint8_t{0});
    forEach(mesh_.tets.size(), [&](std::size_t t) {
      const Tet& tet = mesh_.tets[t];
      if (shapeMeasure(tet, mesh_.nodes) > threshold) flag(tet, stirred_);
    });
  }

  /// Sets the flags of those nodes that are active; several threads may set the same.
  template <class Nodes>
  void flag(const Nodes& meshNodes, std::vector<std::uint8_t>& flags) const {
    for (const std::int32_t v : meshNodes) {
      if (const std::int32_t n = active_.indexOf[v]; n >= 0) setFlag(flags[n]);
    }
  }

  void moveTo(std::int32_t n, const Vector3d& x) {
    const double step2 = (x - position(n)).squaredNorm();
    position(n) = x;
    if (step2 < kStill * kStill * options_.edgeLength * options_.edgeLength) return;
    stirred_[n] = 1;
    for (const StarFaceNodes& face : active_.star(n)) flag(face, stirred_);
  }

  /// Sweeps of Newton steps over the nodes whose worst F is above the threshold, and of these only those that
  /// have moved, or seen a neighbour move, since their last turn.
  void descend(const Descent& descent) {
    for (int sweep = 0; sweep < descent.sweeps; ++sweep) {
      forEachNode<NodeStar>([&](std::int32_t n, NodeStar& star) {
        if (std::exchange(stirred_[n], std::uint8_t{0}) == 0) return;
        gather(n, star);
        double ceiling = descent.ceiling;
        if (descent.threshold > 0 || ceiling < kInfinity) {
          const double worst = star.value(star.origin(), 1).worst;
          if (worst <= descent.threshold) return;
          ceiling = std::max(ceiling, worst);
        }
        isBoundary(n) ? slide(n, star, descent.q, ceiling) : step(n, star, descent.q, ceiling);
      });
    }
  }

  void step(std::int32_t n, const NodeStar& star, int q, double ceiling) {
    const StarDerivatives d = star.derivatives(q);
    const Vector3d step = newtonStep<3>(d.hessian, d.gradient);
    tryStep(n, star, d.energy, q, ceiling,
            [&](double t) { return std::optional<Vector3d>(star.origin() + t * step); });
  }

  /// A step in the tangent plane, then back onto the node's level set.
  void slide(std::int32_t n, const NodeStar& star, int q, double ceiling) {
    Eigen::Matrix<double, 3, 2> tangents;
    if (!tangentPlane(star.origin(), tangents)) return;
    const StarDerivatives d = star.derivatives(q);
    const Vector3d step = tangents * newtonStep<2>(tangents.transpose() * d.hessian * tangents,
                                                   tangents.transpose() * d.gradient);
    tryStep(n, star, d.energy, q, ceiling,
            [&](double t) { return project_(star.origin() + t * step, level_[n]); });
  }

  bool tangentPlane(const Vector3d& x, Eigen::Matrix<double, 3, 2>& tangents) const {
    Vector3d normal;
    phi_.valueAndGradient(x, normal);
    const double norm = normal.norm();
    if (norm < 1e-6) return false;
    tangents.col(0) = (normal / norm).unitOrthogonal();
    tangents.col(1) = (normal / norm).cross(tangents.col(0));
    return true;
  }

  template <int N>
  static Eigen::Matrix<double, N, 1> newtonStep(const Eigen::Matrix<double, N, N>& hessian,
                                                const Eigen::Matrix<double, N, 1>& gradient) {
    const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(hessian);
    if (factor.info() == Eigen::Success) return -factor.solve(gradient);
    return -gradient / std::max(hessian.norm(), 1e-300);
  }

  template <class Target>
  void tryStep(std::int32_t n, const NodeStar& star, double energy, int q, double ceiling,
               const Target& target) {
    for (const double t : {1.0, 0.5, 0.2}) {
      const std::optional<Vector3d> x = target(t);
      if (!x) continue;
      const StarValue value = star.value(*x, q);
      if (value.energy < energy && value.worst <= ceiling) {
        moveTo(n, *x);
        return;
      }
    }
  }

  void finish(const Finish& stretch) {
    std::fill(stirred_.begin(), stirred_.end(), std::uint8_t{1});
    awake_ = nodesOfWorstTets(stretch.above);
    for (int sweep = 0; sweep < stretch.sweeps && any(awake_); ++sweep) {
      forEachNode<GoalStar>([&](std::int32_t n, GoalStar& star) {
        if (std::exchange(stirred_[n], std::uint8_t{0}) != 0) descendGoal(n, star, stretch);
      });
      awake_ = nodesOfWorstTetsAroundAwake(stretch.above);
    }
    std::fill(awake_.begin(), awake_.end(), std::uint8_t{1});
  }

  static bool any(const std::vector<std::uint8_t>& flags) {
    return std::find(flags.begin(), flags.end(), std::uint8_t{1}) != flags.end();
  }

  std::vector<std::uint8_t> nodesOfWorstTets(double above) const {
    std::vector<std::uint8_t> flags(active_.size(), 0);
    forEach(mesh_.tets.size(), [&](std::size_t t) {
      const Tet& tet = mesh_.tets[t];
      if (goalMeasure(tet, mesh_.nodes) > above) flag(tet, flags);
    });
    return flags;
  }

  /// Only tets with a node that was awake can have changed, and a tet without one was good.
  std::vector<std::uint8_t> nodesOfWorstTetsAroundAwake(double above) const {
    std::vector<std::uint8_t> flags(active_.size(), 0);
    forEach(
        awake_.size(),
        [&](std::size_t n) {
          if (awake_[n] == 0) return;
          for (const StarFaceNodes& face : active_.star(static_cast<std::int32_t>(n))) {
            const auto& [a, b, c] = face;
            if (goalMeasure({a, b, c, active_.nodes[n]}, mesh_.nodes) <= above) continue;
            setFlag(flags[n]);
            flag(face, flags);
          }
        },
        kNodeGrain);
    return flags;
  }

  /// Puts the tets first that decide on the gradient of the goal energy.
  /// @return how many they are
  static std::size_t sortDecisive(GoalStar& star, const std::vector<double>& measures, double least) {
    std::size_t decisive = 0;
    for (std::size_t t = 0; t < measures.size(); ++t)
      if (measures[t] >= least) star.swap(decisive++, t);
    return decisive;
  }

  void descendGoal(std::int32_t n, GoalStar& star, const Finish& stretch) {
    const Vector3d x = position(n);
    star.gather(active_.star(n), mesh_.nodes);
    const std::span<const double> row = star.measures(x, star.size());
    const std::vector<double> measures(row.begin(), row.end());
    const double worst = std::ranges::max(measures);
    if (worst > stretch.hopeless) return;
    const double energy = star.energy(x, stretch.power, star.size());
    const double shortestEdge = star.shortestEdge(x);
    const std::size_t decisive = sortDecisive(star, measures, stretch.decisive * worst);
    Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d offset = 1e-4 * shortestEdge * Vector3d::Unit(axis);
      gradient[axis] =
          star.energy(x + offset, stretch.power, decisive) - star.energy(x - offset, stretch.power, decisive);
    }
    if (isBoundary(n)) {
      Eigen::Matrix<double, 3, 2> tangents;
      if (!tangentPlane(x, tangents)) return;
      gradient = (tangents * (tangents.transpose() * gradient)).eval();
    }
    const double norm = gradient.norm();
    if (!(norm > 0) || !std::isfinite(norm)) return;
    for (double step = 0.16; step > 0.002; step *= 0.5) {
      const Vector3d moved = x - step * shortestEdge / norm * gradient;
      const std::optional<Vector3d> target =
          isBoundary(n) ? project_(moved, level_[n]) : std::optional(moved);
      if (target && star.energy(*target, stretch.power, star.size()) < energy) {
        moveTo(n, *target);
        return;
      }
    }
  }

  TetMesh& mesh_;
  const SignedDistance& phi_;
  const CompressionOptions& options_;
  ActiveNodes active_;
  double tolerance_;
  SurfaceProjection project_;
  std::vector<double> level_;          ///< phi at each active boundary node, as it was put there; 0 elsewhere
  std::vector<std::uint8_t> stirred_;  ///< per active node: its star has changed since its last turn
  std::vector<std::uint8_t> awake_;    ///< per active node: takes part in the present sweep
};

}  // namespace

CompressionReport compressOntoSurface(TetMesh& mesh, const SignedDistance& phi,
                                      const CompressionOptions& options,
                                      const std::vector<std::uint8_t>& region) {
  return StarCompressor(mesh, phi, options, region).run();
}

}  // namespace sinew
