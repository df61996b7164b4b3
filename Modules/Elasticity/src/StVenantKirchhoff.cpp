#include "sinew/Elasticity/Material.h"

namespace sinew {
namespace {

using Eigen::Matrix3d;

class StVenantKirchhoff final : public Material {
 public:
  explicit StVenantKirchhoff(const Lame& lame) : lame_(lame) {}

  double energy(std::size_t, const Matrix3d& F) const override {
    const Matrix3d G = strain(F);
    return lame_.lambda / 2 * G.trace() * G.trace() + lame_.mu * G.squaredNorm();
  }

  Matrix3d stress(std::size_t, const Matrix3d& F) const override { return F * secondStress(strain(F)); }

  Matrix3d stressChange(std::size_t, const Matrix3d& F, const Matrix3d& dF) const override {
    const Matrix3d dG = (dF.transpose() * F + F.transpose() * dF) / 2;
    return dF * secondStress(strain(F)) + F * secondStress(dG);
  }

 private:
  /// G = (F^T F - I) / 2
  static Matrix3d strain(const Matrix3d& F) { return (F.transpose() * F - Matrix3d::Identity()) / 2; }

  /// S = lambda tr(G) I + 2 mu G
  Matrix3d secondStress(const Matrix3d& G) const {
    return lame_.lambda * G.trace() * Matrix3d::Identity() + 2 * lame_.mu * G;
  }

  Lame lame_;
};

}  // namespace

std::unique_ptr<Material> stVenantKirchhoff(const Lame& lame) {
  return std::make_unique<StVenantKirchhoff>(lame);
}

}  // namespace sinew
