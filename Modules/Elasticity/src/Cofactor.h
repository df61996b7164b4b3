#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sinew {

/// d(det F)/dF; its columns are cross products of F's.
inline Eigen::Matrix3d cofactor(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d result;
  for (int c = 0; c < 3; ++c) result.col(c) = F.col((c + 1) % 3).cross(F.col((c + 2) % 3));
  return result;
}

/// The derivative of cofactor(F) along dF.
inline Eigen::Matrix3d cofactorChange(const Eigen::Matrix3d& F, const Eigen::Matrix3d& dF) {
  Eigen::Matrix3d result;
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    result.col(c) = dF.col(a).cross(F.col(b)) + F.col(a).cross(dF.col(b));
  }
  return result;
}

inline double innerProduct(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) {
  return A.cwiseProduct(B).sum();
}

}  // namespace sinew
