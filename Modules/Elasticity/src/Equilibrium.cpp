#include "sinew/Elasticity/Equilibrium.h"

#include "ConjugateGradients.h"
#include "NodeSums.h"
#include "TwoLevelPreconditioner.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double largestNorm(const NodeVectors& vectors) {
  double largest = 0;
  for (const Vector3d& vector : vectors) largest = std::max(largest, vector.norm());
  return largest;
}

/// What one Newton problem is made of.
struct Problem {
  const ElasticBody& body;
  const Material& material;
  const NodeConstraints& constraints;
  const NodeVectors& outer;

  double potential(const NodeVectors& places) const {
    const double work = outer.empty() ? 0 : dot(outer, places);
    return elasticEnergy(body, material, places) - work;
  }

  /// What is out of balance on the free parts of the nodes.
  NodeVectors residual(const NodeVectors& places) const {
    NodeVectors forces = outer.empty() ? NodeVectors(body.nodeCount(), Vector3d::Zero()) : outer;
    addElasticForces(body, material, places, forces);
    forEachIndex(forces.size(), [&](std::size_t n) { forces[n] = constraints.free(n, forces[n]); });
    return forces;
  }

  /// The force that residuals are compared with: the largest that a tet gives a node, or from outside.
  double largestForce(const NodeVectors& places) const {
    double largest = outer.empty() ? 0 : largestNorm(outer);
    for (std::size_t t = 0; t < body.tets.size(); ++t) {
      const Matrix3d P = material.stress(t, deformationGradient(body, places, t));
      largest = std::max(largest, body.volumes[t] * (P * body.inverseEdges[t].transpose()).norm());
    }
    return largest;
  }
};

/// The linear systems of one body and its constraints.
class NewtonSystem {
 public:
  NewtonSystem(const ElasticBody& body, const NodeConstraints& constraints)
      : constraints_(constraints), stiffness_(body), preconditioner_(body, stiffness_, constraints) {}

  NodeVectors direction(const Problem& problem, const NodeVectors& places, const NodeVectors& residual,
                        double forcing, const EquilibriumOptions& options, int& iterations) {
    stiffness_.assemble(problem.material, places);
    preconditioner_.update();
    const auto apply = [&](const NodeVectors& in, NodeVectors& out) { stiffness_.multiply(in, out); };
    const auto precondition = [&](const NodeVectors& in, NodeVectors& out) {
      preconditioner_.apply(in, out);
    };
    NodeVectors direction(residual.size(), Vector3d::Zero());
    const CgResult result = conjugateGradients(constraints_, apply, precondition, residual, direction,
                                               {.tolerance = forcing, .iterations = options.cgIterations});
    iterations += result.iterations;
    if (result.iterations == 0)
      preconditioner_.apply(residual, direction);  // negative curvature at once: downhill
    return direction;
  }

 private:
  const NodeConstraints& constraints_;
  StiffnessMatrix stiffness_;
  TwoLevelPreconditioner preconditioner_;
};

/// Halves the step until the potential falls enough and no tet is flat. @return whether a step was found
bool lineSearch(const Problem& problem, const NodeVectors& direction, double slope,
                const EquilibriumOptions& options, NodeVectors& places) {
  constexpr double kArmijo = 1e-4, kLeastStep = 1e-10, kRoundOff = 1e-14;
  const double start = problem.potential(places);
  NodeVectors trial(places.size());
  for (double step = 1; step > kLeastStep; step /= 2) {
    forEachIndex(places.size(), [&](std::size_t n) { trial[n] = places[n] + step * direction[n]; });
    if (options.keepPositive && !(leastVolumeRatio(problem.body, trial) > 0)) continue;
    if (problem.potential(trial) <= start - kArmijo * step * slope + kRoundOff * std::abs(start)) {
      places = std::move(trial);
      return true;
    }
  }
  return false;
}

/// How exactly a Newton step is solved for: the better the nearer, but not beyond what is asked for.
double forcingTerm(double residual, double tolerance) {
  constexpr double kLoosest = 0.1, kTightest = 1e-10, kOfTolerance = 0.1;
  return std::clamp(std::max(residual, kOfTolerance * tolerance / residual), kTightest, kLoosest);
}

}  // namespace

EquilibriumReport findEquilibrium(const ElasticBody& body, const Material& material,
                                  const NodeConstraints& constraints, const NodeVectors& outerForces,
                                  NodeVectors& places, const EquilibriumOptions& options) {
  if (options.keepPositive && !(leastVolumeRatio(body, places) > 0))
    throw std::invalid_argument("findEquilibrium: a tet of the start is flat or inverted");
  const Problem problem{body, material, constraints, outerForces};
  NewtonSystem system(body, constraints);
  EquilibriumReport report;
  for (;; ++report.steps) {
    const NodeVectors residual = problem.residual(places);
    report.largestForce = std::max(problem.largestForce(places), options.leastForce);
    const double largest = largestNorm(residual);
    report.residual = report.largestForce > 0 ? largest / report.largestForce : 0;
    report.converged = report.residual <= options.tolerance;
    if (report.converged || report.steps == options.steps) break;
    if (options.onStep) options.onStep();
    const double forcing = forcingTerm(report.residual, options.tolerance);
    const NodeVectors direction =
        system.direction(problem, places, residual, forcing, options, report.cgIterations);
    if (!lineSearch(problem, direction, dot(residual, direction), options, places)) break;
  }
  report.leastVolumeRatio = leastVolumeRatio(body, places);
  return report;
}

}  // namespace sinew
