#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>

namespace sinew {

/// A hyperelastic law: energy per volume at rest as a function of the deformation gradient F of a tet. Every
/// law here is defined for all F, inverted ones too.
class Material {
 public:
  virtual ~Material() = default;

  /// Psi(F), kPa
  virtual double energy(std::size_t tet, const Eigen::Matrix3d& F) const = 0;
  /// First Piola-Kirchhoff stress P = dPsi/dF, kPa
  virtual Eigen::Matrix3d stress(std::size_t tet, const Eigen::Matrix3d& F) const = 0;
  /// dP = d^2Psi/dF^2 : dF, symmetric as a map of dF, kPa
  virtual Eigen::Matrix3d stressChange(std::size_t tet, const Eigen::Matrix3d& F,
                                       const Eigen::Matrix3d& dF) const = 0;
};

/// Lame's constants of an isotropic material, kPa.
struct Lame {
  double mu = 0;      ///< shear modulus
  double lambda = 0;  ///< bulk modulus - 2/3 mu
};

/// mu = E / (2 (1 + nu)), lambda = E nu / ((1 + nu) (1 - 2 nu))
/// @param young  E, kPa, positive
/// @param poisson  nu, in (-1, 0.5)
/// @throws std::invalid_argument
Lame lame(double young, double poisson);

/// G = (F^T F - I) / 2,  Psi = lambda/2 tr(G)^2 + mu G:G,  P = F (lambda tr(G) I + 2 mu G). Softens under
/// compression: in one dimension the force has its extreme at a stretch of 1/sqrt(3), and an inverted tet at
/// rest.
/// Source: Teran et al. 2003, Finite volume methods for the simulation of skeletal muscle, eq. 7.
std::unique_ptr<Material> stVenantKirchhoff(const Lame& lame);

/// Psi = mu/2 (tr(F^T F) - 3) - mu l(J) + lambda/2 l(J)^2,  l = ln J,  J = det F, which is the Cauchy stress
/// sigma = mu/J (F F^T - I) + lambda ln J / J I. Below J = 0.2, l is the parabola that goes on with value,
/// slope and curvature: flat and inverted tets are pushed back by finite forces.
/// Source: Bonet and Wood, Nonlinear Continuum Mechanics, eq. 6.27; the extension after Teran et al. 2005, section 7.2.
std::unique_ptr<Material> neoHookean(const Lame& lame);

/// Psi = mu |F - R|^2 + lambda/2 tr(R^T F - I)^2 with F = R S its polar decomposition, R a rotation: linear
/// elasticity in the frame that turns with the tet.
/// Source: Mueller and Gross 2004, Interactive virtual materials; Chao et al. 2010 for dR.
std::unique_ptr<Material> corotated(const Lame& lame);

}  // namespace sinew
