#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// Replaces a field by the signed distance to its zero set, in a narrow band: |grad phi| = 1, |phi| = band
/// beyond.
///
/// Samples with a neighbour (of six) on the other side get the distance to the closest point of the tricubic
/// (Catmull-Rom) interpolant's zero set; from there second-order upwind differences carry it outward, nearest
/// samples first, on each side by itself. The raster is marched in tiles with a halo as wide as the band.
/// @param phi  negative inside; zero counts as outside. No sample changes side.
/// @param spacing  along each axis, mm; need not be equal
/// @param band  half width, mm
/// @throws std::invalid_argument unless spacing > 0 and band > 0.
/// Cost: O(samples + band), tiles in parallel; the same bits for any number of threads.
/// Source: Sethian 1996 (fast marching), Chopp 2001 (closest point on a cubic patch), Yatziv, Bartesaghi,
/// Sapiro 2006 (queue of buckets).
void fastMarching(DenseField& phi, const Eigen::Vector3d& spacing, double band);

}  // namespace sinew
