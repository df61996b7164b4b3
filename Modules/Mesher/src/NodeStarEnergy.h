#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <span>

namespace sinew {

/// A tet seen from one of its nodes x: the opposite face (a, b, c), turned so that (x-a).((b-a)x(c-a)) = 6 V
/// > 0.
using StarFaceNodes = std::array<std::int32_t, 3>;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// F = L^3 / (432 (6V)^2) with L the sum of the squared edges; 1 for the regular tet, infinite when not
/// positive.
inline double shapeMeasure(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ax = x - a;
  const double volume6 = ax.dot(ab.cross(ac));
  if (volume6 <= 0) return kInfinity;
  const double L = ab.squaredNorm() + ac.squaredNorm() + (c - b).squaredNorm() + ax.squaredNorm() +
                   (x - b).squaredNorm() + (x - c).squaredNorm();
  return L * L * L / (432 * volume6 * volume6);
}

/// base^q for the small integer powers that the descent uses.
inline double power(double base, int q) {
  double result = 1;
  for (; q > 0; q >>= 1, base *= base) {
    if ((q & 1) != 0) result *= base;
  }
  return result;
}

/// Sum of F^q over a star, and its largest F; both infinite when a tet is not positive.
struct StarValue {
  double energy = 0;
  double worst = 0;
};
StarValue starValue(const Eigen::Vector3d& x, std::span<const StarFaceNodes> star,
                    const std::vector<Eigen::Vector3d>& nodes, int q);

/// Gradient and Hessian of the sum of F^q with respect to x.
struct StarDerivatives {
  double energy = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};
StarDerivatives starDerivatives(const Eigen::Vector3d& x, std::span<const StarFaceNodes> star,
                                const std::vector<Eigen::Vector3d>& nodes, int q);

}  // namespace sinew
