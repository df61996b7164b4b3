#pragma once

#include "sinew/Elasticity/Springs.h"
#include "sinew/Elasticity/StrainLimits.h"
#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/SignedDistance.h"

namespace sinew {

/// What a candidate mesh is made of while it is pushed onto the surface: springs along edges and altitudes, or
/// finite elements.
enum class MeshingForces { Springs, FiniteElements };

/// Law of the finite elements.
enum class MeshingMaterial { NeoHookean, StVenantKirchhoff, Corotated };

/// The body is fictitious and soft, and only ratios count. Its unit of time is what a wave takes through a
/// tet: the same for all tets whatever their size, because the density of a tet goes with 1 / altitude^2.
struct PhysicsCompressionOptions {
  MeshingForces forces = MeshingForces::FiniteElements;
  MeshingMaterial material = MeshingMaterial::NeoHookean;  ///< of finite elements
  double poisson = 0.1;                                    ///< of finite elements, in (-1, 0.5)
  /// Of springs, see AltitudeSpringOptions. Which spring of a tet acts changes from step to step: these jumps
  /// of the forces keep the body in motion (4 % of the largest kinetic energy on a ball) unless there is some
  /// damping, 0.1. The worst aspect ratio is then that of all springs within 5 % on balls of 8 edges and more,
  /// a torus, a capsule and a box; of a ball of 6 edges it is 8 % larger.
  bool shortestOnly = false;
  double actsBelow = 2;         ///< of springs, see AltitudeSpringOptions; 2: always; below 1 the same holds
  double damping = 0;           ///< inside of tets: share of what is critical, >= 0
  double drag = 0.6;            ///< of nodes: their speed decays with this rate per unit of time, >= 0
  double push = 1;              ///< force on a boundary node per mass and |phi|, per unit of time^2, > 0
  int forceSteps = 4;           ///< of the stage of forces, >= 0
  int velocitySteps = 40;       ///< of the stage of velocities, at most, > 0
  double stillness = 2e-2;      ///< it ends below this part of the largest kinetic energy, > 0
  StrainLimitOptions limits{};  ///< per step
};

/// @throws std::invalid_argument naming the first option out of range
void requireSound(const PhysicsCompressionOptions& options);

struct PhysicsCompressionReport {
  std::int64_t tets = 0;  ///< of the body: those near the boundary
  int forceSteps = 0;     ///< taken
  int velocitySteps = 0;  ///< taken
  int cgIterations = 0;
  double maxPhiAfterForces = 0;  ///< largest |phi| of a boundary node, edge lengths
  double maxPhi = 0;             ///< the same at the end of the motion
  double kineticEnergy = 0;      ///< at the end, as part of the largest
  bool converged = false;        ///< the kinetic energy is below the stillness and |phi| below kNearSurface
  std::int64_t leftBehind = 0;   ///< nodes that went back towards the candidate to keep tets positive
};

/// |phi| in edge lengths from which boundary nodes are put onto the surface exactly.
inline constexpr double kNearSurface = 2e-2;

/// Pushes a candidate mesh onto phi = 0 as an elastic body whose shape at rest is the candidate's: first by
/// forces on the boundary nodes along the mesh normal, proportional to phi, against which the body may push
/// back; then by velocities along it that take phi to 0, with the nodes free tangentially. Only the tets near
/// the boundary take part. All tets stay positive, but some can be badly shaped, and nodes stay off the
/// surface, where the candidate asks too much.
/// @throws std::invalid_argument on options out of range
/// The same bits for any number of threads. Cost: O(tets near the boundary x steps).
/// Source: Teran et al. 2005, section 7; Molino et al. 2003.
PhysicsCompressionReport compressByPhysics(TetMesh& mesh, const SignedDistance& phi,
                                           const CompressionOptions& options,
                                           const PhysicsCompressionOptions& physics = {});

}  // namespace sinew
