#pragma once

#include "sinew/Elasticity/Springs.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <stdexcept>

namespace sinew {

/// Rejects a sound speed or damping out of range.
inline void requireSound(const SpringOptions& options) {
  if (!(options.soundSpeed > 0)) throw std::invalid_argument("springs: the sound speed must be positive");
  if (!(options.damping >= 0)) throw std::invalid_argument("springs: the damping must not be negative");
  if (!(options.crossingTime >= 0))
    throw std::invalid_argument("springs: the crossing time must not be negative");
}

/// k / l0 = c^2 m / l0^2, kg/s^2
inline double springRate(const SpringOptions& options, double mass, double length) {
  const double c = options.crossingTime > 0 ? length / options.crossingTime : options.soundSpeed;
  return c * c * mass / (length * length);
}

inline double harmonicMean(double a, double b) { return 2 * a * b / (a + b); }

/// Forces on all four nodes of a tet as addTetForces takes them: those on nodes 1, 2, 3.
class TetForces {
 public:
  void add(int corner, const Eigen::Vector3d& force) {
    if (corner > 0) columns_.col(corner - 1) += force;
  }
  const Eigen::Matrix3d& columns() const { return columns_; }

 private:
  Eigen::Matrix3d columns_ = Eigen::Matrix3d::Zero();
};

}  // namespace sinew
