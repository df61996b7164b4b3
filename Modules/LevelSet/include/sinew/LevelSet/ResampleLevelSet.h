#pragma once

#include "sinew/LevelSet/SampleLattice.h"

namespace sinew {

/// A level set after a motion, on the samples of a lattice: tricubic, then a signed distance again. With the
/// identity it is the way onto another lattice.
/// @param motion  LPS mm to LPS mm: a rigid motion, which may scale evenly
/// @param band  of the result, mm
/// @throws std::invalid_argument when the motion shears or scales unevenly.
/// Cost: O(samples of the result), in parallel.
DenseLevelSet resampled(const DenseLevelSet& levelSet, const SampleLattice& lattice, double band,
                        const Eigen::Affine3d& motion = Eigen::Affine3d::Identity());

}  // namespace sinew
