#pragma once

#include <Eigen/Geometry>
#include <openvdb/math/Transform.h>

#include <cmath>
#include <optional>

namespace sinew {

/// Index i to  frame * (voxelSize * i), as OpenVDB has it.
inline openvdb::math::Transform::Ptr gridTransform(const Eigen::Isometry3d& frame, double voxelSize) {
  const Eigen::Matrix3d steps = frame.linear() * voxelSize;
  openvdb::Mat4d rows = openvdb::Mat4d::identity();  // OpenVDB multiplies row vectors
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) rows[a][b] = steps(b, a);
    rows[3][a] = frame.translation()[a];
  }
  return openvdb::math::Transform::createLinearTransform(rows);
}

struct GridFrame {
  Eigen::Isometry3d frame;
  double voxelSize;
};

/// The way back; empty when the samples are stretched, sheared, mirrored, or not on straight lines.
inline std::optional<GridFrame> gridFrame(const openvdb::math::Transform& transform) {
  constexpr double kTolerance = 1e-5;  // transforms may have been computed in single precision
  if (!transform.isLinear()) return std::nullopt;
  const openvdb::Mat4d rows = transform.baseMap()->getAffineMap()->getMat4();
  Eigen::Matrix3d steps;
  Eigen::Vector3d origin;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) steps(b, a) = rows[a][b];
    origin[a] = rows[3][a];
  }
  const double voxelSize = std::cbrt(steps.determinant());
  const Eigen::Matrix3d metric = steps.transpose() * steps / (voxelSize * voxelSize);
  if (!(voxelSize > 0) || !origin.allFinite() || !metric.isIdentity(kTolerance)) return std::nullopt;
  GridFrame result{Eigen::Isometry3d::Identity(), voxelSize};
  result.frame.linear() =
      Eigen::Quaterniond(Eigen::Matrix3d(steps / voxelSize)).normalized().toRotationMatrix();
  result.frame.translation() = origin;
  return result;
}

}  // namespace sinew
