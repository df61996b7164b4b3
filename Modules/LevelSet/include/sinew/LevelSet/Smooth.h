#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/LevelSet/ShapeMeasures.h"

namespace sinew {

/// What smoothing has to keep.
enum class Preserve { Nothing, Volume, Topology, Both };

struct SmoothOptions {
  double time = 0;   ///< b t of the motion by mean curvature, mm^2, >= 0 (METHOD [12]); a sphere of radius R
                     ///< becomes one of sqrt(R^2 - 4 time)
  double sigma = 0;  ///< standard deviation of a Gauss on phi, mm, >= 0; comes first
  Preserve preserve = Preserve::Both;
};

struct SmoothReport {
  double volumeBefore = 0, volumeAfter = 0;  ///< mm^3
  ShapeTopology before, after;
  std::int64_t heldSamples = 0;  ///< samples whose change of side was refused to keep the topology
  double offset = 0;             ///< by which the surface was moved outward to keep the volume, mm
};

/// Smooths a shape. Volume: within 0.1 %, by even offsets on the way, unless the shape is worn down to what the
/// topology holds; volumeAfter says what came of it. Topology: a sample changes side only while it is
/// a simple point (26-connected inside, 6-connected outside), so that no piece, tunnel or cavity comes or
/// goes.
/// @param levelSet  a signed distance in its band; a signed distance afterwards
/// @throws std::invalid_argument on negative options, and on a sigma above 100 samples.
SmoothReport smooth(DenseLevelSet& levelSet, const SmoothOptions& options);

}  // namespace sinew
