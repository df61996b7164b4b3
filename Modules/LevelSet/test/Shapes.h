#pragma once

#include "sinew/LevelSet/Redistance.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <cmath>

namespace sinew::test {

/// A formula, sampled on [-half, half]^3 at the given spacing, as a signed distance in the band.
template <typename Function>
DenseLevelSet levelSetOf(const Function& phi, double half = 20, double spacing = 1, double band = 4) {
  const int n = static_cast<int>(std::ceil(half / spacing));
  DenseLevelSet shape =
      emptyLevelSet({.spacing = spacing}, Eigen::Vector3i::Constant(-n), Eigen::Vector3i::Constant(n), band);
  for (int k = 0; k <= 2 * n; ++k)
    for (int j = 0; j <= 2 * n; ++j)
      for (int i = 0; i <= 2 * n; ++i)
        shape.phi(i, j, k) = static_cast<float>(
            phi(Eigen::Vector3d(spacing * (Eigen::Vector3d(i, j, k) - Eigen::Vector3d::Constant(n)))));
  redistance(shape);
  return shape;
}

/// phi of a ball.
inline auto ball(const Eigen::Vector3d& center, double radius) {
  return [=](const Eigen::Vector3d& x) { return (x - center).norm() - radius; };
}

/// phi of a rounded-off box's kin: positive inside edges count as the largest of the three distances.
inline auto block(const Eigen::Vector3d& center, const Eigen::Vector3d& halfSides) {
  return [=](const Eigen::Vector3d& x) { return ((x - center).cwiseAbs() - halfSides).maxCoeff(); };
}

}  // namespace sinew::test
