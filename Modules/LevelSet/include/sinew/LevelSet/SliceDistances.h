#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// Replaces every slice k of a field by the signed distance, within the slice, to the slice's zero contour.
///
/// The contour is that of marching squares: straight pieces between the linear crossings on the grid's edges,
/// so it lies where the field says, not at pixel borders. Near it the distance is exact, beyond three pixels
/// it is that to the nearest crossing (at most 0.05 pixels more).
/// @param field  negative inside
/// @param pixel  spacing in x and y, mm
/// @param limit  values are clamped to +-limit, mm; slices without a contour hold +-limit
/// @throws std::invalid_argument unless pixel and limit are positive.
/// Cost: O(samples), slices in parallel; the same bits for any number of threads.
/// Source: Felzenszwalb, Huttenlocher 2012 (lower envelope of parabolas).
void sliceDistances(DenseField& field, const Eigen::Vector2d& pixel, double limit);

}  // namespace sinew
