#include "NeoHookeanLaw.h"

namespace sinew {
namespace {

using Eigen::Matrix3d;

class NeoHookean final : public Material {
 public:
  explicit NeoHookean(const Lame& lame) : law_{lame.mu, lame.lambda} {}

  double energy(std::size_t, const Matrix3d& F) const override { return law_.energy(F); }
  Matrix3d stress(std::size_t, const Matrix3d& F) const override { return law_.stress(F); }
  Matrix3d stressChange(std::size_t, const Matrix3d& F, const Matrix3d& dF) const override {
    return law_.stressChange(F, dF);
  }

 private:
  NeoHookeanLaw law_;
};

}  // namespace

std::unique_ptr<Material> neoHookean(const Lame& lame) { return std::make_unique<NeoHookean>(lame); }

}  // namespace sinew
