#pragma once

#include "sinew/Mesher/SignedDistance.h"

namespace sinew {

/// Principal curvatures of the level set of phi through a point, 1/mm, k1 >= k2; positive where the shape is
/// convex.
struct PrincipalCurvatures {
  double k1 = 0;
  double k2 = 0;
  /// |k1| + |k2|: unlike the mean curvature it does not cancel at saddles.
  double magnitude() const;
};

/// Eigenvalues of P H P / |grad phi| with H the Hessian and P = I - N N^T, the one along N dropped
/// (Teran et al. 2005, section 5). H from central differences of the gradient at distance `step`, mm.
PrincipalCurvatures principalCurvatures(const SignedDistance& phi, const Eigen::Vector3d& x, double step);

}  // namespace sinew
