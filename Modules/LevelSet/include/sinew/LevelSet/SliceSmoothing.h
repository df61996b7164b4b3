#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

struct SliceSmoothingOptions {
  int passes = 2;                 ///< >= 0
  double tolerancePixels = 0.75;  ///< how far one pass may move a contour, > 0
};

/// Takes the jitter between slices out of their contours: contours are drawn slice by slice, each right to a
/// pixel at best, and the differences would show as ripples across the slices. Beside a contour
///     d_k += (d_(k-1) - 2 d_k + d_(k+1)) / 4
/// as far as the step stays within the tolerance, beyond which it fades out: then it is no jitter.
/// Neighbouring pixels share the mean of their steps. Parts and gaps thinner than about four pixels, and
/// contours that move by more than four and a half pixels per slice, are left alone.
/// @param slices  signed distance per slice, mm (see sliceDistances); changed only near the contours
/// @param pixel  mm, the smaller one of the two
/// @throws std::invalid_argument on options out of range or a pixel that is not positive.
/// Cost: O(samples) per pass and as much memory, in parallel; the same bits for any number of threads.
void smoothAcrossSlices(DenseField& slices, double pixel, const SliceSmoothingOptions& options = {});

}  // namespace sinew
