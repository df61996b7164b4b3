#include "NearestSurfacePoint.h"

#include <cmath>

namespace sinew {

std::optional<Eigen::Vector3d> nearestSurfacePoint(const SignedDistance& phi, double offset,
                                                   const Eigen::Vector3d& x) {
  constexpr int kMostSteps = 8;
  constexpr double kSmallestSlope = 0.1;  // of a signed distance: below, x is near the medial axis
  const double near = 1e-3 * phi.resolution();
  Eigen::Vector3d point = x, gradient;
  for (int step = 0; step < kMostSteps; ++step) {
    const double distance = phi.valueAndGradient(point, gradient) - offset;
    if (std::abs(distance) <= near) return point;
    const double slope = gradient.squaredNorm();
    if (slope < kSmallestSlope * kSmallestSlope) return std::nullopt;
    point -= distance / slope * gradient;
  }
  return std::nullopt;
}

}  // namespace sinew
