#pragma once

#include "sinew/Elasticity/ForceModel.h"
#include "sinew/Elasticity/NodeConstraints.h"

#include <functional>

namespace sinew {

struct Motion {
  NodeVectors places;      ///< mm
  NodeVectors velocities;  ///< mm/s
  double time = 0;         ///< s
};

struct NewmarkOptions {
  double tolerance = 1e-8;  ///< of the conjugate gradients
  int iterations = 200;     ///< of the conjugate gradients, at most
  /// Changes velocities that would strain tets too much, see StrainLimits; called twice per step. May be
  /// empty.
  std::function<void(const NodeVectors& places, double dt, NodeVectors& velocities)> limit = {};
};

struct NewmarkReport {
  int iterations = 0;  ///< of both conjugate gradients
  bool converged = true;
};

/// One step of the modified central Newmark scheme: explicit in the forces, implicit in the damping,
///     v* = v + dt/2 a(x, v*),  limit v*,  x' = x + dt v*,  v' = v + dt/2 (a(x, v) + a(x', v')),  limit v'
/// Second order in dt; stable for dt below about the least altitude over the speed of sound, whatever the
/// damping. Held nodes have exactly their prescribed velocities.
/// @param forces  moved to the new places
/// @throws std::invalid_argument unless dt > 0
/// Source: Bridson, Marino, Fedkiw 2003, section 3; Teran et al. 2005, section 7.3.
NewmarkReport newmarkStep(const ElasticBody& body, ForceModel& forces, const NodeConstraints& constraints,
                          double dt, Motion& motion, const NewmarkOptions& options = {});

/// A step that is stable: the share `courant` of the least altitude over the speed of sound, s.
double stableStep(const ElasticBody& body, const NodeVectors& places, double soundSpeed,
                  double courant = 0.5);

/// uJ
double kineticEnergy(const ElasticBody& body, const NodeVectors& velocities);

}  // namespace sinew
