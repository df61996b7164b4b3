#pragma once

#include "sinew/Elasticity/ElasticBody.h"
#include "sinew/Elasticity/Material.h"

namespace sinew {

/// Sum of V Psi(F) over the tets, uJ. The same bits for any number of threads, like all sums here.
double elasticEnergy(const ElasticBody& body, const Material& material, const NodeVectors& places);

/// Adds -dE/dx to `forces`, mN: a tet does P A_i N_i / 3, summed over the faces at it, to each of its nodes,
/// with N_i the outward normals and A_i the areas at rest, which is -V P Dm^-T. Cost: O(tets).  Source: Teran
/// et al. 2003, Finite volume methods, section 5.
void addElasticForces(const ElasticBody& body, const Material& material, const NodeVectors& places,
                      NodeVectors& forces);

/// Adds the change of the elastic forces along `steps` (mm per node), -K d.
void addElasticForceChange(const ElasticBody& body, const Material& material, const NodeVectors& places,
                           const NodeVectors& steps, NodeVectors& changes);

/// Viscosity of St Venant-Kirchhoff form, kPa s.
struct Damping {
  double alpha = 0;  ///< of the rate of volume
  double beta = 0;   ///< of the rate of shape
};

/// Damping forces at fixed places, linear in the velocities:
///     G' = sym(F^T F'),  S = alpha tr(G') I + 2 beta G',  P = F S
/// They turn with the body, keep both momenta, and take energy at the rate of the integral of S:G' >= 0: the
/// matrix is symmetric and negative semidefinite.  Source: Teran et al. 2003, eq. 8; 2005, section 7.2.
class DampingForces {
 public:
  DampingForces(const ElasticBody& body, Damping damping);

  /// Keeps F of every tet for the calls to come.
  void moveTo(const NodeVectors& places);

  void add(const NodeVectors& velocities, NodeVectors& forces) const;

 private:
  const ElasticBody& body_;
  Damping damping_;
  std::vector<Eigen::Matrix3d> F_;
};

}  // namespace sinew
