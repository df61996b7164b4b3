#pragma once

#include "sinew/Mesher/SignedDistance.h"

#include <optional>

namespace sinew {

/// The point of phi = offset that Newton's steps along the gradient reach from x; nothing where they do not
/// come within a thousandth of phi's resolution. All in phi's frame, mm.
std::optional<Eigen::Vector3d> nearestSurfacePoint(const SignedDistance& phi, double offset,
                                                   const Eigen::Vector3d& x);

}  // namespace sinew
