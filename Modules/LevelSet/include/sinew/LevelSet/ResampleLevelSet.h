#pragma once

#include "sinew/LevelSet/SampleLattice.h"

namespace sinew {

/// A level set after a motion, on the samples of a lattice: tricubic, then a signed distance again. With the
/// identity it is the way onto another lattice. Where the moved samples are the lattice's own they are kept.
/// @param motion  LPS mm to LPS mm: a rotation, mirroring or translation that may scale evenly
/// @param band  of the result, mm
/// @throws std::invalid_argument when the motion shears, scales unevenly or is not finite, unless band > 0,
/// and when the result would have more than 2^31 samples.
/// Cost: O(samples of the result), in parallel; the same bits for any number of threads.
DenseLevelSet resampled(const DenseLevelSet& levelSet, const SampleLattice& lattice, double band,
                        const Eigen::Affine3d& motion = Eigen::Affine3d::Identity());

}  // namespace sinew
