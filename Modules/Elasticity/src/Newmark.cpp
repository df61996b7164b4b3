#include "sinew/Elasticity/Newmark.h"

#include "ConjugateGradients.h"
#include "NodeSums.h"
#include "sinew/Elasticity/Altitude.h"

#include <algorithm>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// Solves (M - dt/2 D) v = momentum for the free parts, from v.
CgResult solveDamped(const ElasticBody& body, const ForceModel& forces, const NodeConstraints& constraints,
                     double dt, const NodeVectors& momentum, NodeVectors& v, const NewmarkOptions& options) {
  NodeVectors damping(body.nodeCount());
  const auto apply = [&](const NodeVectors& in, NodeVectors& out) {
    std::ranges::fill(damping, Vector3d::Zero());
    forces.addDamping(in, damping);
    forEachIndex(in.size(), [&](std::size_t n) { out[n] = body.masses[n] * in[n] - dt / 2 * damping[n]; });
  };
  const auto precondition = [&](const NodeVectors& in, NodeVectors& out) {
    forEachIndex(in.size(), [&](std::size_t n) { out[n] = constraints.free(n, in[n] / body.masses[n]); });
  };
  return conjugateGradients(constraints, apply, precondition, momentum, v,
                            {.tolerance = options.tolerance, .iterations = options.iterations});
}

}  // namespace

NewmarkReport newmarkStep(const ElasticBody& body, ForceModel& forces, const NodeConstraints& constraints,
                          double dt, Motion& motion, const NewmarkOptions& options) {
  if (!(dt > 0)) throw std::invalid_argument("newmarkStep: the step must be positive");
  const std::size_t nodes = body.nodeCount();
  NodeVectors& x = motion.places;
  NodeVectors v = motion.velocities, force(nodes, Vector3d::Zero()), momentum(nodes);
  const auto prescribe = [&](NodeVectors& velocities) {
    forEachIndex(nodes, [&](std::size_t n) { velocities[n] = constraints.prescribed(n, velocities[n]); });
  };
  const auto solve = [&](NodeVectors& velocities) {
    return solveDamped(body, forces, constraints, dt, momentum, velocities, options);
  };

  forces.moveTo(x);
  forces.addForces(x, force);
  forEachIndex(nodes, [&](std::size_t n) { momentum[n] = body.masses[n] * v[n] + dt / 2 * force[n]; });
  NodeVectors half = v;
  prescribe(half);
  const CgResult first = solve(half);
  if (options.limit) options.limit(x, dt, half);

  forces.addDamping(v, force);
  forEachIndex(nodes, [&](std::size_t n) { x[n] += dt * half[n]; });
  forces.moveTo(x);
  forces.addForces(x, force);
  forEachIndex(nodes, [&](std::size_t n) { momentum[n] = body.masses[n] * v[n] + dt / 2 * force[n]; });
  prescribe(v);
  const CgResult second = solve(v);
  if (options.limit) options.limit(x, dt, v);

  motion.velocities = std::move(v);
  motion.time += dt;
  return {.iterations = first.iterations + second.iterations,
          .converged = first.converged && second.converged};
}

double stableStep(const ElasticBody& body, const NodeVectors& places, double soundSpeed, double courant) {
  double least = 1e300;
  for (const Tet& tet : body.tets) least = std::min(least, leastAltitude(places, tet));
  return courant * least / soundSpeed;
}

double kineticEnergy(const ElasticBody& body, const NodeVectors& velocities) {
  return deterministicSum(body.nodeCount(),
                          [&](std::size_t n) { return body.masses[n] * velocities[n].squaredNorm() / 2; });
}

}  // namespace sinew
