#include "sinew/Elasticity/Muscle.h"

#include "NeoHookeanLaw.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double mix(double share, double muscle, double tendon) { return (1 - share) * muscle + share * tendon; }

/// Half of the active curve, over the distance from the optimal stretch: 1 - 4 d^2 up to 0.4, then 9 (d -
/// 0.6)^2 to 0.6.
constexpr double kParabolaEnd = 0.4, kActiveEnd = 0.6;

double activeAt(double d) {
  if (d <= kParabolaEnd) return 1 - 4 * d * d;
  return d < kActiveEnd ? 9 * (d - kActiveEnd) * (d - kActiveEnd) : 0;
}

/// From 0 to d.
double activeIntegral(double d) {
  const auto parabola = [](double e) { return e - 4. / 3 * e * e * e; };
  const auto tail = [](double e) { return 3 * (e - kActiveEnd) * (e - kActiveEnd) * (e - kActiveEnd); };
  if (d <= kParabolaEnd) return parabola(d);
  return parabola(kParabolaEnd) + tail(std::min(d, kActiveEnd)) - tail(kParabolaEnd);
}

double activeDerivative(double d) {
  if (d <= kParabolaEnd) return -8 * d;
  return d < kActiveEnd ? 18 * (d - kActiveEnd) : 0;
}

}  // namespace

double FibreCurves::passive(double stretch) const {
  if (stretch <= 1) return 0;
  const double s = std::min(stretch, straightFrom);
  return toeFactor * (std::exp(toeExponent * (s - 1)) - 1) + passiveSlope(s) * (stretch - s);
}

double FibreCurves::passiveSlope(double stretch) const {
  if (stretch <= 1) return 0;
  return toeFactor * toeExponent * std::exp(toeExponent * (std::min(stretch, straightFrom) - 1));
}

double FibreCurves::passiveEnergy(double stretch) const {
  if (stretch <= 1) return 0;
  const double s = std::min(stretch, straightFrom), d = stretch - s;
  return toeFactor * ((std::exp(toeExponent * (s - 1)) - 1) / toeExponent - (s - 1)) + passive(s) * d +
         passiveSlope(s) * d * d / 2;
}

double FibreCurves::active(double stretch) { return activeAt(std::abs(stretch - 1)); }

double FibreCurves::activeSlope(double stretch) {
  return std::copysign(1, stretch - 1) * activeDerivative(std::abs(stretch - 1));
}

double FibreCurves::activeEnergy(double stretch) {
  return std::copysign(1, stretch - 1) * activeIntegral(std::abs(stretch - 1));
}

Muscle::Muscle(std::vector<MuscleFibre> fibres, const MuscleOptions& options)
    : fibres_(std::move(fibres)), options_(options) {
  for (const double modulus : {options.shear, options.bulk, options.tension, options.tendonShear,
                               options.tendonBulk, options.tendonTension})
    if (!(modulus > 0)) throw std::invalid_argument("Muscle: every modulus and tension must be positive");
  constexpr double kUnit = 1e-6;
  for (std::size_t t = 0; t < fibres_.size(); ++t) {
    if (!(std::abs(fibres_[t].direction.norm() - 1) < kUnit))
      throw std::invalid_argument("Muscle: the fibre of tet " + std::to_string(t) + " is no unit vector");
    if (!(fibres_[t].tendon >= 0 && fibres_[t].tendon <= 1))
      throw std::invalid_argument("Muscle: the share of tendon of tet " + std::to_string(t) +
                                  " is not in [0, 1]");
  }
}

Lame Muscle::matrix(std::size_t tet) const {
  const double share = fibres_[tet].tendon;
  const double mu = mix(share, options_.shear, options_.tendonShear);
  return {.mu = mu, .lambda = mix(share, options_.bulk, options_.tendonBulk) - 2. / 3 * mu};
}

double Muscle::fibreTension(std::size_t tet, double stretch) const {
  const double share = fibres_[tet].tendon;
  return mix(share, options_.tension, options_.tendonTension) * options_.fibres.passive(stretch) +
         (1 - share) * options_.tension * activation_ * FibreCurves::active(stretch);
}

double Muscle::fibreTensionSlope(std::size_t tet, double stretch) const {
  const double share = fibres_[tet].tendon;
  return mix(share, options_.tension, options_.tendonTension) * options_.fibres.passiveSlope(stretch) +
         (1 - share) * options_.tension * activation_ * FibreCurves::activeSlope(stretch);
}

double Muscle::energy(std::size_t tet, const Matrix3d& F) const {
  const Lame lame = matrix(tet);
  const MuscleFibre& fibre = fibres_[tet];
  const double stretch = (F * fibre.direction).norm();
  return NeoHookeanLaw{lame.mu, lame.lambda}.energy(F) +
         mix(fibre.tendon, options_.tension, options_.tendonTension) *
             options_.fibres.passiveEnergy(stretch) +
         (1 - fibre.tendon) * options_.tension * activation_ * FibreCurves::activeEnergy(stretch);
}

Matrix3d Muscle::stress(std::size_t tet, const Matrix3d& F) const {
  const Lame lame = matrix(tet);
  const Vector3d& a = fibres_[tet].direction;
  const Vector3d Fa = F * a;
  const double s = Fa.norm();
  const Matrix3d isotropic = NeoHookeanLaw{lame.mu, lame.lambda}.stress(F);
  return s > 0 ? Matrix3d(isotropic + fibreTension(tet, s) / s * Fa * a.transpose()) : isotropic;
}

/// d(T(s) u) = T' (u.dFa) u + T/s (dFa - u (u.dFa)),  u = Fa / s
Matrix3d Muscle::stressChange(std::size_t tet, const Matrix3d& F, const Matrix3d& dF) const {
  const Lame lame = matrix(tet);
  const Vector3d& a = fibres_[tet].direction;
  const Vector3d Fa = F * a, dFa = dF * a;
  const double s = Fa.norm();
  const Matrix3d isotropic = NeoHookeanLaw{lame.mu, lame.lambda}.stressChange(F, dF);
  if (!(s > 0)) return isotropic;
  const Vector3d u = Fa / s, along = u * u.dot(dFa);
  return isotropic +
         (fibreTensionSlope(tet, s) * along + fibreTension(tet, s) / s * (dFa - along)) * a.transpose();
}

}  // namespace sinew
