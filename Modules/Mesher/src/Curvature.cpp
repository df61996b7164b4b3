#include "sinew/Mesher/Curvature.h"

#include <Eigen/Geometry>

#include <cmath>

namespace sinew {

double PrincipalCurvatures::magnitude() const { return std::abs(k1) + std::abs(k2); }

PrincipalCurvatures principalCurvatures(const SignedDistance& phi, const Eigen::Vector3d& x, double step) {
  Eigen::Matrix3d hessian;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d forward, backward;
    const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(axis);
    phi.valueAndGradient(x + offset, forward);
    phi.valueAndGradient(x - offset, backward);
    hessian.col(axis) = (forward - backward) / (2 * step);
    gradient += (forward + backward) / 6;
  }
  hessian = 0.5 * (hessian + hessian.transpose()).eval();
  const double norm = gradient.norm();
  if (norm < 1e-9) return {};
  const Eigen::Vector3d normal = gradient / norm;
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  // P H P restricted to the tangent plane (u, v), a symmetric 2 x 2 matrix.
  const double a = u.dot(hessian * u) / norm, b = u.dot(hessian * v) / norm, c = v.dot(hessian * v) / norm;
  const double mean = 0.5 * (a + c), radius = std::hypot(0.5 * (a - c), b);
  return {mean + radius, mean - radius};
}

}  // namespace sinew
