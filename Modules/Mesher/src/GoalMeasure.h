#pragma once

#include "NodeStarEnergy.h"

#include <cmath>

namespace sinew {

/// What a mesh is judged by, as one number per tet: at most 1 when the aspect ratio is at most
/// kGoalAspectRatio and every dihedral angle lies within [30, 130] degrees; infinite when the tet is not
/// positive.
///
///     m = max( AR / 3,  max over the edges of |cos theta - c| / r ),   [c - r, c + r] = [cos 130, cos 30]
inline constexpr double kGoalAspectRatio = 3;
inline constexpr double kGoalCosMin = -0.6427876096865394, kGoalCosMax = 0.8660254037844387;
inline constexpr double kGoalCosineCentre = 0.5 * (kGoalCosMax + kGoalCosMin),
                        kGoalCosineRadius = 0.5 * (kGoalCosMax - kGoalCosMin);

inline double goalMeasure(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, bc = c - b, ax = x - a, bx = x - b, cx = x - c;
  // Inward normals of the faces opposite to x, a, b, c; lengths are twice the areas.
  const std::array<Eigen::Vector3d, 4> n{ab.cross(ac), cx.cross(bx), ax.cross(cx), bx.cross(ax)};
  const double volume6 = ax.dot(n[0]);
  if (volume6 <= 0) return kInfinity;
  std::array<double, 4> area{};
  for (int f = 0; f < 4; ++f) area[f] = n[f].norm();
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm(), ax.squaredNorm(),
                                    bx.squaredNorm(), cx.squaredNorm()});
  const double aspect = std::sqrt(longest2) * std::max({area[0], area[1], area[2], area[3]}) / volume6;
  double measure = aspect / kGoalAspectRatio;
  for (const auto& [f, g] : kTetEdges) {
    const double cosine = -n[f].dot(n[g]) / (area[f] * area[g]);
    measure = std::max(measure, std::abs(cosine - kGoalCosineCentre) / kGoalCosineRadius);
  }
  return measure;
}

inline double goalMeasure(const Tet& tet, const std::vector<Eigen::Vector3d>& nodes) {
  return goalMeasure(nodes[tet[3]], nodes[tet[0]], nodes[tet[1]], nodes[tet[2]]);
}

}  // namespace sinew
