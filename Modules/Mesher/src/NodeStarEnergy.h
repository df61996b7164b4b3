#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
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

inline double shapeMeasure(const Tet& tet, const std::vector<Eigen::Vector3d>& nodes) {
  return shapeMeasure(nodes[tet[3]], nodes[tet[0]], nodes[tet[1]], nodes[tet[2]]);
}

/// base^q for the small integer powers that the descent uses.
inline double power(double base, int q) {
  double result = 1;
  for (; q > 0; q >>= 1, base *= base) {
    if ((q & 1) != 0) result *= base;
  }
  return result;
}

/// Writes the coordinates of the faces' nodes into nine rows of a length: x, y, z of the first node of every
/// face, then of the second and the third.
void gatherCorners(std::span<const StarFaceNodes> faces, const std::vector<Eigen::Vector3d>& nodes,
                   std::size_t rowLength, double* rows);

/// Sum of F^q over a star, and its largest F; both infinite when a tet is not positive.
struct StarValue {
  double energy = 0;
  double worst = 0;
};

/// Gradient and Hessian of the sum of F^q with respect to the node.
struct StarDerivatives {
  double energy = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// The tets around one node as functions of the node's place x = origin + d, their other nodes held:
///
///     6V(d) = v + n.d        n = (b-a) x (c-a)
///     L(d)  = l - 2 s.d + 3 d.d    s = a + b + c - 3 origin
///
/// Gathered once per visit of a node, evaluated several times; one row per coefficient, so that the loops
/// over the tets become vector instructions.
class NodeStar {
 public:
  /// @param origin  where the node is; values are most exact near it
  void gather(std::span<const StarFaceNodes> faces, const std::vector<Eigen::Vector3d>& nodes,
              const Eigen::Vector3d& origin);

  const Eigen::Vector3d& origin() const { return origin_; }
  /// @param q  1, 2, 4, 8 or 16
  StarValue value(const Eigen::Vector3d& x, int q) const;
  /// At the origin, where all tets must be positive.
  StarDerivatives derivatives(int q) const;

 private:
  enum Row { kNx, kNy, kNz, kV, kSx, kSy, kSz, kL, kCorners, kRows = kCorners + 9 };
  const double* row(Row r) const { return rows_.data() + static_cast<std::size_t>(r) * capacity_; }
  double* row(Row r) { return rows_.data() + static_cast<std::size_t>(r) * capacity_; }

  Eigen::Vector3d origin_;
  std::size_t tets_ = 0, capacity_ = 0;
  std::vector<double> rows_;
};

}  // namespace sinew
