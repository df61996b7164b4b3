#include "PolarRotation.h"

#include "Cofactor.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace sinew {
namespace {

using Eigen::Matrix3d;

/// The last singular direction is turned where U V^T would mirror.
Matrix3d rotationBySingularValues(const Matrix3d& F) {
  const Eigen::JacobiSVD<Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) *= -1;
  return U * svd.matrixV().transpose();
}

}  // namespace

Matrix3d polarRotation(const Matrix3d& F) {
  constexpr int kMostSteps = 20;
  constexpr double kSmallDeterminant = 1e-3, kSettled = 1e-30;
  Matrix3d R = F;
  for (int step = 0; step < kMostSteps; ++step) {
    const Matrix3d C = cofactor(R);
    const double J = R.col(0).dot(C.col(0));
    if (!(J > kSmallDeterminant)) break;
    const Matrix3d next = (R + C / J) / 2;
    const double change = (next - R).squaredNorm();
    R = next;
    if (change < kSettled) return R;
  }
  return rotationBySingularValues(F);
}

}  // namespace sinew
