#pragma once

#include "sinew/Elasticity/Material.h"

#include <vector>

namespace sinew {

/// Tension of a muscle's fibres over the stretch of the fibre, as part of the largest isometric tension.
/// Source: Zajac 1989; the formulas of Blemker, Pinsky and Delp 2005, appendix.
struct FibreCurves {
  double toeFactor = 0.05;   ///< P1: passive tension of the toe is P1 (exp(P2 (stretch - 1)) - 1)
  double toeExponent = 6.6;  ///< P2
  double straightFrom =
      1.4;  ///< stretch from which the passive tension is a line with the slope it has there

  /// Zero in compression.
  double passive(double stretch) const;
  double passiveSlope(double stretch) const;
  /// Of full activation: 1 at the optimal stretch 1, zero below 0.4 and above 1.6.
  static double active(double stretch);
  static double activeSlope(double stretch);
  /// Integrals from stretch 1.
  double passiveEnergy(double stretch) const;
  static double activeEnergy(double stretch);
};

struct MuscleOptions {
  double shear = 10;     ///< mu of the matrix between the fibres, kPa
  double bulk = 500;     ///< K, kPa: volume is kept the better the larger it is
  double tension = 300;  ///< largest isometric tension of the fibres, kPa
  FibreCurves fibres = {};

  double tendonShear = 50;      ///< kPa
  double tendonBulk = 1000;     ///< kPa
  double tendonTension = 3000;  ///< factor of the tendon's passive curve, kPa; a tendon has no active part
};

/// What one tet of a muscle is.
struct MuscleFibre {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector at rest
  double tendon = 0;                                     ///< share of tendon, 0 for muscle, 1 for tendon
};

/// Transversely isotropic, quasi-incompressible muscle and tendon:
///     Psi = mu/2 (tr(F^T F) - 3) - mu l(J) + (K - 2/3 mu)/2 l(J)^2
///           + T integral_1^s (passive + activation active) ds
///     P   = neo-Hookean + T (passive(s) + activation active(s)) (F a) a^T / s,   s = |F a|
/// with l the logarithm of neoHookean(), a the fibre at rest.
/// Source: Teran et al. 2005, section 8; Blemker et al. 2005; Weiss et al. 1996.
class Muscle final : public Material {
 public:
  /// @throws std::invalid_argument when a modulus is not positive, a fibre is no unit vector or a share is
  /// not in [0, 1]
  explicit Muscle(std::vector<MuscleFibre> fibres, const MuscleOptions& options = {});

  /// Activation of all muscle fibres, in [0, 1].
  void activate(double activation) { activation_ = activation; }
  double activation() const { return activation_; }

  double energy(std::size_t tet, const Eigen::Matrix3d& F) const override;
  Eigen::Matrix3d stress(std::size_t tet, const Eigen::Matrix3d& F) const override;
  Eigen::Matrix3d stressChange(std::size_t tet, const Eigen::Matrix3d& F,
                               const Eigen::Matrix3d& dF) const override;

  /// The fibre's tension dPsi/ds over the area at rest at a stretch, kPa.
  double fibreTension(std::size_t tet, double stretch) const;

 private:
  double fibreTensionSlope(std::size_t tet, double stretch) const;
  Lame matrix(std::size_t tet) const;

  std::vector<MuscleFibre> fibres_;
  MuscleOptions options_;
  double activation_ = 0;
};

}  // namespace sinew
