#pragma once

#include "sinew/Mesher/SignedDistance.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sinew {

/// Finds points of level sets of phi.
class SurfaceProjection {
 public:
  /// @param tolerance  |phi - level| of an answer, mm
  SurfaceProjection(const SignedDistance& phi, double tolerance) : phi_(phi), tolerance_(tolerance) {}

  /// The point of phi = level next to x: Newton steps along grad phi; where they fail to settle (kinks of the
  /// interpolant), bisection along the first of them.
  std::optional<Eigen::Vector3d> operator()(const Eigen::Vector3d& start, double level) const {
    Eigen::Vector3d x = start, gradient;
    for (int step = 0; step < kNewtonSteps; ++step) {
      const double distance = phi_.valueAndGradient(x, gradient) - level;
      if (std::abs(distance) <= tolerance_) return x;
      const double norm = gradient.norm();
      if (norm < kFlat) return std::nullopt;
      x -= distance / (norm * std::max(norm, kMinSlope)) * gradient;
    }
    return bisect(start, level);
  }

 private:
  static constexpr int kNewtonSteps = 8;
  static constexpr int kBisections = 40;
  static constexpr double kFlat = 1e-3;
  static constexpr double kMinSlope =
      0.5;  // where phi is flatter than this it still is a distance: no longer step

  std::optional<Eigen::Vector3d> bisect(const Eigen::Vector3d& start, double level) const {
    Eigen::Vector3d gradient;
    const double distance = phi_.valueAndGradient(start, gradient) - level;
    const Eigen::Vector3d reach = -3 * distance * gradient.normalized();
    const double sign = distance > 0 ? 1 : -1;
    double near = 0, far = 1;
    if (sign * (phi_.value(start + reach) - level) > 0) return std::nullopt;
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (near + far);
      const Eigen::Vector3d x = start + middle * reach;
      const double value = phi_.value(x) - level;
      if (std::abs(value) <= tolerance_) return x;
      (sign * value > 0 ? near : far) = middle;
    }
    return std::nullopt;
  }

  const SignedDistance& phi_;
  double tolerance_;
};

}  // namespace sinew
