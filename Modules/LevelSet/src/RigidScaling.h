#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {

/// The factor s of a motion  x -> s R x + t,  R orthogonal.
/// @throws std::invalid_argument that begins with `operation` when the motion shears, scales unevenly, or
/// is not finite.
inline double evenScale(const Eigen::Affine3d& motion, const std::string& operation) {
  constexpr double kTolerance = 1e-6;  // of the scale; a motion may come from a file
  const Eigen::Matrix3d steps = motion.linear();
  const double scale = std::cbrt(std::abs(steps.determinant()));
  const Eigen::Matrix3d metric = steps.transpose() * steps;
  const bool even =
      (metric - scale * scale * Eigen::Matrix3d::Identity()).norm() <= kTolerance * scale * scale;
  if (!motion.matrix().allFinite() || !(scale > 0) || !even)
    throw std::invalid_argument(
        operation + ": the motion must be a rotation, mirroring or translation that may scale evenly");
  return scale;
}

}  // namespace sinew
