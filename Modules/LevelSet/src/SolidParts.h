#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {

[[noreturn]] inline void refuse(const std::string& what) { throw std::invalid_argument(what); }

inline void requireFinite(const Eigen::Vector3d& point, const std::string& name) {
  if (!point.allFinite()) refuse(name + " must be finite");
}

inline void requirePositive(double length, const std::string& name) {
  if (!(length > 0) || !std::isfinite(length))
    refuse(name + " must be positive, got " + std::to_string(length));
}

inline void requireNotNegative(double length, const std::string& name) {
  if (!(length >= 0) || !std::isfinite(length))
    refuse(name + " must not be negative, got " + std::to_string(length));
}

inline Eigen::AlignedBox3d ballBounds(const Eigen::Vector3d& center, double radius) {
  return {center - Eigen::Vector3d::Constant(radius), center + Eigen::Vector3d::Constant(radius)};
}

/// A point by its distance from an axis and its place along it.
struct Axis {
  Eigen::Vector3d origin, direction;  ///< a unit vector

  Eigen::Vector2d operator()(const Eigen::Vector3d& x) const {
    const double along = direction.dot(x - origin);
    return {(x - origin - along * direction).norm(), along};
  }
};

}  // namespace sinew
