#include "sinew/Elasticity/Equilibrium.h"

#include "ConjugateGradients.h"
#include "NodeSums.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// dP/dF of every tet, F and P as columns below each other.
using Tangent = Eigen::Matrix<double, 9, 9>;

std::vector<Tangent> tangents(const ElasticBody& body, const Material& material, const NodeVectors& places) {
  std::vector<Tangent> result(body.tets.size());
  forEachIndex(result.size(), [&](std::size_t t) {
    const Matrix3d F = deformationGradient(body, places, t);
    for (int entry = 0; entry < 9; ++entry) {
      Matrix3d unit = Matrix3d::Zero();
      unit(entry % 3, entry / 3) = 1;
      result[t].col(entry) = material.stressChange(t, F, unit).reshaped();
    }
  });
  return result;
}

/// The gradient of a node's shape function at rest: the node's step d changes F by d g^T.
Vector3d shapeGradient(const ElasticBody& body, std::size_t tet, std::size_t corner) {
  const Matrix3d& inverse = body.inverseEdges[tet];
  if (corner > 0) return inverse.row(static_cast<Eigen::Index>(corner - 1)).transpose();
  return -inverse.colwise().sum().transpose();
}

/// The inverses of the 3 x 3 blocks of K on its diagonal, made positive where they are not.
std::vector<Matrix3d> inverseBlocks(const ElasticBody& body, const std::vector<Tangent>& tangents) {
  std::vector<Matrix3d> inverses(body.nodeCount());
  forEachIndex(body.nodeCount(), [&](std::size_t n) {
    Matrix3d block = Matrix3d::Zero();
    for (std::int32_t k = body.firstCorner[n]; k < body.firstCorner[n + 1]; ++k) {
      const auto corner = static_cast<std::size_t>(body.corners[static_cast<std::size_t>(k)]);
      const std::size_t tet = corner / 4;
      const Vector3d g = shapeGradient(body, tet, corner % 4);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          block += body.volumes[tet] * g[i] * g[j] * tangents[tet].block<3, 3>(3 * i, 3 * j);
    }
    const Eigen::LLT<Matrix3d> factors(block);
    inverses[n] = factors.info() == Eigen::Success
                      ? Matrix3d(factors.solve(Matrix3d::Identity()))
                      : Matrix3d(Matrix3d::Identity() / std::max(block.norm(), 1e-300));
  });
  return inverses;
}

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
  double forceScale(const NodeVectors& places) const {
    double largest = outer.empty() ? 0 : largestNorm(outer);
    for (std::size_t t = 0; t < body.tets.size(); ++t) {
      const Matrix3d P = material.stress(t, deformationGradient(body, places, t));
      largest = std::max(largest, body.volumes[t] * (P * body.inverseEdges[t].transpose()).norm());
    }
    return largest;
  }
};

NodeVectors newtonDirection(const Problem& problem, const NodeVectors& places, const NodeVectors& residual,
                            double forcing, const EquilibriumOptions& options, int& iterations) {
  const std::vector<Tangent> tangent = tangents(problem.body, problem.material, places);
  const std::vector<Matrix3d> inverses = inverseBlocks(problem.body, tangent);
  const auto apply = [&](const NodeVectors& in, NodeVectors& out) {
    std::ranges::fill(out, Vector3d::Zero());
    addTetForces(
        problem.body,
        [&](std::size_t t) -> Matrix3d {
          const Matrix3d dF = deformationGradient(problem.body, in, t);
          const Eigen::Matrix<double, 9, 1> dP = tangent[t] * dF.reshaped();
          return problem.body.volumes[t] * dP.reshaped(3, 3) * problem.body.inverseEdges[t].transpose();
        },
        out);
  };
  const auto precondition = [&](std::size_t n, const Vector3d& r) -> Vector3d { return inverses[n] * r; };
  NodeVectors direction(residual.size(), Vector3d::Zero());
  const CgResult result = conjugateGradients(problem.constraints, apply, precondition, residual, direction,
                                             {.tolerance = forcing, .iterations = options.cgIterations});
  iterations += result.iterations;
  if (result.iterations == 0)  // negative curvature at once: downhill
    forEachIndex(direction.size(), [&](std::size_t n) {
      direction[n] = problem.constraints.free(n, precondition(n, residual[n]));
    });
  return direction;
}

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

}  // namespace

EquilibriumReport findEquilibrium(const ElasticBody& body, const Material& material,
                                  const NodeConstraints& constraints, const NodeVectors& outerForces,
                                  NodeVectors& places, const EquilibriumOptions& options) {
  if (options.keepPositive && !(leastVolumeRatio(body, places) > 0))
    throw std::invalid_argument("findEquilibrium: a tet of the start is flat or inverted");
  const Problem problem{body, material, constraints, outerForces};
  EquilibriumReport report;
  for (;; ++report.steps) {
    const NodeVectors residual = problem.residual(places);
    const double scale = problem.forceScale(places), largest = largestNorm(residual);
    report.residual = scale > 0 ? largest / scale : 0;
    report.converged = largest <= options.tolerance * scale;
    if (report.converged || report.steps == options.steps) break;
    constexpr double kLoosest = 0.1, kTightest = 1e-10;
    const double forcing = std::clamp(report.residual, kTightest, kLoosest);
    const NodeVectors direction =
        newtonDirection(problem, places, residual, forcing, options, report.cgIterations);
    if (!lineSearch(problem, direction, dot(residual, direction), options, places)) break;
  }
  report.leastVolumeRatio = leastVolumeRatio(body, places);
  return report;
}

}  // namespace sinew
