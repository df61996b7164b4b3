#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

struct ReinitializeOptions {
  int maxIterations = 60;  ///< pseudo-time steps, >= 1
  double cfl = 0.45;       ///< pseudo-time step over sample spacing, in (0, 0.5]
  double tolerance =
      0.002;  ///< done when no sample of the band changes faster: largest ||grad phi| - 1|, > 0
};

struct ReinitializeReport {
  bool converged = false;        ///< the tolerance was met
  int iterations = 0;            ///< pseudo-time steps taken
  double meanGradientError = 0;  ///< of ||grad phi| - 1| in the band, upwind differences
  double maxGradientError = 0;
  double largestMovement = 0;  ///< of the surface along the raster's edges, mm
};

/// Makes a field a signed distance again by its own evolution,
///     phi_tau + S(phi0) (|grad phi| - 1) = 0,   S = +-1 by the side,
/// with Godunov's upwind choice between one-sided differences of second order (ENO: of two second differences
/// the smaller, so that neither looks across a kink or a thin part's other side). Beside the surface a
/// difference ends on the surface itself, where the ENO parabola of phi0 has its zero, so that the surface
/// stays. Pseudo-time goes by Heun's rule. fastMarching does the same at a fraction of the cost; this one needs no order of the samples, keeps
/// thin parts better, and says how far it got.
/// @param phi  negative inside; zero counts as outside. No sample changes side. |phi| = band beyond the band.
/// @param spacing  of the samples along every axis, mm
/// @param band  half width, mm
/// @throws std::invalid_argument on an argument out of range.
/// Cost: O(samples) + iterations * O(band), in parallel; the same bits for any number of threads.
/// Source: Sussman, Smereka, Osher 1994; Russo, Smereka 2000 (sub-cell fix); Min 2010 (second order).
ReinitializeReport reinitialize(DenseField& phi, double spacing, double band,
                                const ReinitializeOptions& options = {});

}  // namespace sinew
