#pragma once

#include "sinew/Elasticity/ElasticForces.h"
#include "sinew/Elasticity/NodeConstraints.h"

#include <functional>

namespace sinew {

struct EquilibriumOptions {
  double tolerance = 1e-8;   ///< largest out-of-balance force over the largest force that a tet gives a node
  double leastForce = 0;     ///< mN: what that largest force counts for at least; for states near rest
  int steps = 100;           ///< Newton steps at most
  int cgIterations = 2000;   ///< per Newton step at most
  bool keepPositive = true;  ///< no step may take a tet to J <= 0
  std::function<void()> onStep = {};  ///< called before each Newton step; what it throws comes through
};

struct EquilibriumReport {
  bool converged = false;
  int steps = 0;
  int cgIterations = 0;
  double residual = 0;      ///< out-of-balance force over that of the tets, see tolerance
  double largestForce = 0;  ///< that a tet gives a node, or from outside, or leastForce; mN
  double leastVolumeRatio = 1;
};

/// Moves the free nodes to where elastic and outer forces are in balance: a minimum of E(x) - f.x, by
/// Newton's method with conjugate gradients (which stop at directions of negative curvature, and know patches
/// of nodes that move rigidly) and a backtracking line search that never takes a tet to J <= 0. The held nodes stay where they are: put them in
/// place first.
/// @param outerForces  dead loads, mN per node; empty for none
/// @param places  start, then the result
/// @throws std::invalid_argument when keepPositive and a tet of the start has J <= 0
/// Cost: per Newton step about 30 evaluations of the forces for the matrix, then its products.
/// Source: Nocedal and Wright 2006, algorithm 7.1 (line search Newton-CG).
EquilibriumReport findEquilibrium(const ElasticBody& body, const Material& material,
                                  const NodeConstraints& constraints, const NodeVectors& outerForces,
                                  NodeVectors& places, const EquilibriumOptions& options = {});

}  // namespace sinew
