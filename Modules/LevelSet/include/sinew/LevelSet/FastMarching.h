#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

struct FastMarchingOptions {
  int order = 2;  ///< of the upwind differences, 1 or 2
  /// Samples this many steps along the axes from the other side, 1 to 3, start at the closest point of the
  /// tricubic interpolant, not only those beside the surface: second derivatives of phi near the surface
  /// need 3. Where none is found the march decides.
  int closestPointLayers = 1;
};

/// Replaces a field by the signed distance to its zero set, in a narrow band: |grad phi| = 1, |phi| = band
/// beyond.
///
/// Samples with a neighbour (of six) on the other side get the distance to the closest point of the tricubic
/// (Catmull-Rom) interpolant's zero set; from there second-order upwind differences carry it outward, nearest
/// samples first, on each side by itself. The raster is marched in tiles with a halo as wide as the band.
/// @param phi  negative inside; zero counts as outside. No sample changes side.
/// @param spacing  along each axis, mm; need not be equal
/// @param band  half width, mm: where the march stops
/// @throws std::invalid_argument unless spacing > 0 and band > 0 and the options are in range.
/// Cost: O(samples + band), tiles in parallel; the same bits for any number of threads.
/// Source: Sethian 1996 (fast marching), Rickett, Fomel 1999 (second order), Chopp 2001 (closest point on a
/// cubic patch), Yatziv, Bartesaghi, Sapiro 2006 (queue of buckets).
void fastMarching(DenseField& phi, const Eigen::Vector3d& spacing, double band,
                  const FastMarchingOptions& options = {});

/// A sample and what is known of its distance.
struct MarchSeed {
  Eigen::Vector3i at;
  double distance;  ///< mm, >= 0
};

/// The distance, along ways that stay on one side, from seeds of known distance:
///     phi(x) = +- min over seeds s of (distance_s + |x - s|),  as upwind differences have it;
/// the seeds keep theirs.
/// @param phi  its signs tell the two sides; a field without negative samples gives an unsigned distance.
///             Replaced by the distances, +-band beyond the band and where no seed is on the side.
/// @param seeds  in any order; of several at one sample the nearest counts
/// @param options  the order of the differences; layers mean nothing here
/// @throws std::invalid_argument on a seed outside of the raster or of no or negative distance, and as
/// fastMarching does.  Cost and source: as fastMarching.
void marchFromSeeds(DenseField& phi, const std::vector<MarchSeed>& seeds, const Eigen::Vector3d& spacing,
                    double band, const FastMarchingOptions& options = {});

}  // namespace sinew
