#include "NodeStarEnergy.h"

namespace sinew {

using Eigen::Vector3d;

StarValue starValue(const Vector3d& x, std::span<const StarFaceNodes> star,
                    const std::vector<Vector3d>& nodes, int q) {
  StarValue value;
  for (const auto& [a, b, c] : star) {
    const double F = shapeMeasure(x, nodes[a], nodes[b], nodes[c]);
    if (F == kInfinity) return {kInfinity, kInfinity};
    value.energy += power(F, q);
    value.worst = std::max(value.worst, F);
  }
  return value;
}

//     ln F = 3 ln L - 2 ln(6V) + const,   g = grad ln F = 3 grad L / L - 2 n / (6V),   n = (b-a) x (c-a)
//     H = hess ln F = 18 I / L - 3 grad L grad L^T / L^2 + 2 n n^T / (6V)^2
//     grad F^q = q F^q g,   hess F^q = q F^q (H + q g g^T)
StarDerivatives starDerivatives(const Vector3d& x, std::span<const StarFaceNodes> star,
                                const std::vector<Vector3d>& nodes, int q) {
  double energy = 0, diagonal = 0;
  double gx = 0, gy = 0, gz = 0;
  double hxx = 0, hxy = 0, hxz = 0, hyy = 0, hyz = 0, hzz = 0;
  for (const auto& [ia, ib, ic] : star) {
    const Vector3d &a = nodes[ia], &b = nodes[ib], &c = nodes[ic];
    const Vector3d ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const Vector3d n = ab.cross(ac);
    const double volume6 = ax.dot(n);
    const double L = ab.squaredNorm() + ac.squaredNorm() + (c - b).squaredNorm() + ax.squaredNorm() +
                     bx.squaredNorm() + cx.squaredNorm();
    const double inverseL = 1 / L, inverseV = 1 / volume6;
    const double F = L * L * L * inverseV * inverseV / 432;
    const double Fq = power(F, q), weight = q * Fq;
    const Vector3d u = (2 * inverseL) * (ax + bx + cx);  // grad L / L
    const Vector3d v = inverseV * n;                     // grad 6V / 6V
    const Vector3d g = 3 * u - 2 * v;
    energy += Fq;
    diagonal += weight * 18 * inverseL;
    gx += weight * g.x();
    gy += weight * g.y();
    gz += weight * g.z();
    const double wg = weight * q, wu = -3 * weight, wv = 2 * weight;
    hxx += wg * g.x() * g.x() + wu * u.x() * u.x() + wv * v.x() * v.x();
    hxy += wg * g.x() * g.y() + wu * u.x() * u.y() + wv * v.x() * v.y();
    hxz += wg * g.x() * g.z() + wu * u.x() * u.z() + wv * v.x() * v.z();
    hyy += wg * g.y() * g.y() + wu * u.y() * u.y() + wv * v.y() * v.y();
    hyz += wg * g.y() * g.z() + wu * u.y() * u.z() + wv * v.y() * v.z();
    hzz += wg * g.z() * g.z() + wu * u.z() * u.z() + wv * v.z() * v.z();
  }
  StarDerivatives d;
  d.energy = energy;
  d.gradient = {gx, gy, gz};
  d.hessian << hxx + diagonal, hxy, hxz, hxy, hyy + diagonal, hyz, hxz, hyz, hzz + diagonal;
  return d;
}

}  // namespace sinew
