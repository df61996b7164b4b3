#pragma once

#include "NodeSums.h"
#include "sinew/Elasticity/NodeConstraints.h"

#include <cmath>

namespace sinew {

inline double dot(const NodeVectors& a, const NodeVectors& b) {
  return deterministicSum(a.size(), [&](std::size_t n) { return a[n].dot(b[n]); });
}

struct CgResult {
  int iterations = 0;
  bool converged = false;
  bool negativeCurvature = false;  ///< it ended at a direction along which the matrix is not positive
};

struct CgLimits {
  double tolerance = 1e-8;  ///< of the residual over that of the start, in the preconditioner's norm
  int iterations = 500;
};

/// Solves A x = b for the free parts of the nodes, from x as it is; what constraints hold stays as it is in
/// x.
/// @param apply  (in, out): out = A in, for a symmetric A
/// @param precondition  (in, out): out = an approximation of A^-1 in, symmetric, positive, for the free parts
/// Source: Shewchuk 1994, B3; the filter of Baraff and Witkin 1998, section 5.
template <class Apply, class Precondition>
CgResult conjugateGradients(const NodeConstraints& constraints, const Apply& apply,
                            const Precondition& precondition, const NodeVectors& b, NodeVectors& x,
                            const CgLimits& limits) {
  const std::size_t nodes = b.size();
  NodeVectors residual(nodes), preconditioned(nodes), direction(nodes), image(nodes);
  apply(x, image);
  forEachIndex(nodes, [&](std::size_t n) { residual[n] = constraints.free(n, b[n] - image[n]); });
  precondition(residual, preconditioned);
  direction = preconditioned;
  double rho = dot(residual, preconditioned);
  const double enough = limits.tolerance * limits.tolerance * rho;
  CgResult result;
  for (; result.iterations < limits.iterations && rho > enough; ++result.iterations) {
    apply(direction, image);
    const double curvature = dot(direction, image);
    if (!(curvature > 0)) {
      result.negativeCurvature = true;
      return result;
    }
    const double alpha = rho / curvature;
    forEachIndex(nodes, [&](std::size_t n) {
      x[n] += alpha * direction[n];
      residual[n] -= alpha * constraints.free(n, image[n]);
    });
    precondition(residual, preconditioned);
    const double next = dot(residual, preconditioned), beta = next / rho;
    forEachIndex(nodes, [&](std::size_t n) { direction[n] = preconditioned[n] + beta * direction[n]; });
    rho = next;
  }
  result.converged = rho <= enough;
  return result;
}

}  // namespace sinew
