#include "PolarRotation.h"
#include "sinew/Elasticity/Material.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// W = (w x .)
Matrix3d crossMatrix(const Vector3d& w) {
  Matrix3d W;
  W << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return W;
}

/// dR = R W, with (tr(S) I - S) w the axial vector of R^T dF - dF^T R; zero where that has no single answer.
Matrix3d rotationChange(const Matrix3d& R, const Matrix3d& F, const Matrix3d& dF) {
  const Matrix3d S = R.transpose() * F, T = R.transpose() * dF, skew = T - T.transpose();
  const Matrix3d A = S.trace() * Matrix3d::Identity() - S;
  constexpr double kSingular = 1e-12;
  const double scale = A.norm();
  if (!(std::abs(A.determinant()) > kSingular * scale * scale * scale)) return Matrix3d::Zero();
  return R * crossMatrix(A.inverse() * Vector3d(skew(2, 1), skew(0, 2), skew(1, 0)));
}

class Corotated final : public Material {
 public:
  explicit Corotated(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  double energy(std::size_t, const Matrix3d& F) const override {
    const Matrix3d R = polarRotation(F);
    const double stretch = R.cwiseProduct(F).sum() - 3;
    return mu_ * (F - R).squaredNorm() + lambda_ / 2 * stretch * stretch;
  }

  /// P = 2 mu (F - R) + lambda tr(R^T F - I) R
  Matrix3d stress(std::size_t, const Matrix3d& F) const override {
    const Matrix3d R = polarRotation(F);
    return 2 * mu_ * (F - R) + lambda_ * (R.cwiseProduct(F).sum() - 3) * R;
  }

  Matrix3d stressChange(std::size_t, const Matrix3d& F, const Matrix3d& dF) const override {
    const Matrix3d R = polarRotation(F), dR = rotationChange(R, F, dF);
    return 2 * mu_ * (dF - dR) + lambda_ * R.cwiseProduct(dF).sum() * R +
           lambda_ * (R.cwiseProduct(F).sum() - 3) * dR;
  }

 private:
  double mu_, lambda_;
};

}  // namespace

std::unique_ptr<Material> corotated(const Lame& lame) { return std::make_unique<Corotated>(lame); }

}  // namespace sinew
