#pragma once

#include "Cofactor.h"
#include "ExtendedLog.h"
#include "sinew/Elasticity/Material.h"

#include <Eigen/LU>

namespace sinew {

/// The law of neoHookean(), for materials that add to it.
struct NeoHookeanLaw {
  double mu, lambda;

  double energy(const Eigen::Matrix3d& F) const {
    const ExtendedLog l(F.determinant());
    return mu / 2 * (F.squaredNorm() - 3) - mu * l.value + lambda / 2 * l.value * l.value;
  }

  /// P = mu F + (lambda l - mu) l' cof F
  Eigen::Matrix3d stress(const Eigen::Matrix3d& F) const {
    const ExtendedLog l(F.determinant());
    return mu * F + (lambda * l.value - mu) * l.slope * cofactor(F);
  }

  Eigen::Matrix3d stressChange(const Eigen::Matrix3d& F, const Eigen::Matrix3d& dF) const {
    const ExtendedLog l(F.determinant());
    const Eigen::Matrix3d C = cofactor(F);
    const double dJ = innerProduct(C, dF);
    return mu * dF + (lambda * l.slope * l.slope + (lambda * l.value - mu) * l.curvature) * dJ * C +
           (lambda * l.value - mu) * l.slope * cofactorChange(F, dF);
  }
};

}  // namespace sinew
