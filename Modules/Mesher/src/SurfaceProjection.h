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
  /// interpolant near sharp edges), the first crossing along grad phi at x.
  std::optional<Eigen::Vector3d> operator()(const Eigen::Vector3d& start, double level) const {
    Eigen::Vector3d x = start, gradient;
    for (int step = 0; step < kNewtonSteps; ++step) {
      const double distance = phi_.valueAndGradient(x, gradient) - level;
      if (std::abs(distance) <= tolerance_) return x;
      const double slope = gradient.norm();
      if (slope < kFlat) break;
      // phi is a distance, so the surface is near; flatter places are kinks, crossed by no more than a
      // sample.
      const double length = std::min(std::abs(distance) / slope, std::abs(distance) + phi_.resolution());
      x -= std::copysign(length / slope, distance) * gradient;
    }
    return firstCrossing(start, level);
  }

 private:
  static constexpr int kNewtonSteps = 12;
  static constexpr int kBisections = 50;
  static constexpr int kSamples = 8;
  static constexpr double kFlat = 1e-3;

  std::optional<Eigen::Vector3d> firstCrossing(const Eigen::Vector3d& start, double level) const {
    Eigen::Vector3d gradient;
    const double distance = phi_.valueAndGradient(start, gradient) - level;
    if (gradient.norm() < kFlat) return std::nullopt;
    const double sign = std::copysign(1.0, distance);
    const Eigen::Vector3d reach =
        -sign * (1.5 * std::abs(distance) + 2 * phi_.resolution()) * gradient.normalized();
    const auto excess = [&](double t) { return sign * (phi_.value(start + t * reach) - level); };
    double near = 0, far = 0;
    for (int k = 1; k <= kSamples && far == 0; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      (excess(t) > 0 ? near : far) = t;
    }
    if (far == 0) return std::nullopt;
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (near + far), value = excess(middle);
      if (std::abs(value) <= tolerance_) return start + middle * reach;
      (value > 0 ? near : far) = middle;
    }
    return std::nullopt;
  }

  const SignedDistance& phi_;
  double tolerance_;
};

}  // namespace sinew
