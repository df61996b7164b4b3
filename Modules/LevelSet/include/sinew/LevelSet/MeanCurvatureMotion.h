#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

struct MeanCurvatureMotionOptions {
  double cfl = 1.0 / 6;        ///< largest  b dt / h^2, in (0, 1/6]
  int stepsPerRedistance = 8;  ///< phi is made a distance again after this many steps, >= 1
};

/// What the motion did.
struct MeanCurvatureMotionReport {
  int steps = 0;
  int redistances = 0;  ///< fast marches, the last one included
};

/// Moves the surface by its mean curvature for a time t:
///     phi_t = b kappa |grad phi|,   kappa = div (grad phi / |grad phi|) = k1 + k2,
/// explicit in time with b dt <= cfl h^2, by central differences, within four samples of the surface, with
/// fast marching in between. A ball of radius R becomes one of sqrt(R^2 - 4 b t), a cylinder of
/// sqrt(R^2 - 2 b t); pieces that shrink to nothing are gone. Where grad phi vanishes, on the skeleton, the
/// direction in which phi bends most counts as the normal: a plate does not move, a ball's centre rises.
/// @param phi  a signed distance, mm, negative inside; a signed distance afterwards, +-band beyond the band.
///             Across the raster's border phi goes on as it is there.
/// @param spacing  of the samples along every axis, mm
/// @param time  b t, mm^2; 0 leaves phi as it is
/// @param band  half width of the band of the result, mm
/// @throws std::invalid_argument on an argument out of range.
/// Cost: per step O(samples of the band), per redistance one fastMarching; in parallel, the same bits for any
/// number of threads.
/// Source: Osher, Sethian 1988; Teran et al. 2005, section 3 (whose (k1 + k2)/2 is a slip).
MeanCurvatureMotionReport meanCurvatureMotion(DenseField& phi, double spacing, double time, double band,
                                              const MeanCurvatureMotionOptions& options = {});

}  // namespace sinew
