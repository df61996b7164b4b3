#pragma once

#include <Eigen/Core>

namespace sinew {

/// The rotation nearest to F, also for a flat or inverted one: R of F = R S, det R = 1, S symmetric.
/// Cost: a few Newton steps R <- (R + R^-T) / 2 (Higham 1986); the singular value decomposition where det F
/// is small or negative.
Eigen::Matrix3d polarRotation(const Eigen::Matrix3d& F);

}  // namespace sinew
