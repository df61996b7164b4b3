#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <vector>

namespace sinew {

/// Shape interpolation across slices: between two slices of signed distances the surface moves from one
/// contour to the other.
///
/// Catmull-Rom through four slices, never with a sign that both neighbours lack. Four cases are told apart
/// from that:
/// - a piece of tissue (or of background) without counterpart on the next slice ends in a rounded cap that
/// fills half
///   of the space to that slice, which is what the voxels say, or less where its contours have been shrinking
///   (the end of a ball);
/// - a piece whose counterpart is far away on one side, so that the ramp would lose (or gain) much of that
/// half, has
///   its distances limited until the balance is right;
/// - a thin part that runs so aslant that its two contours touch but hardly overlap is joined, with their
/// mean area
///   half way;
/// - everything else is left alone.
/// @param slices  signed distance per slice, mm, negative inside; the outermost slices without tissue
/// @param sliceSpacing  mm; cap roundings are as wide
/// @param positions  continuous slice indices of the planes wanted, ascending, in [0, slices.size.z() - 1]
/// @param limit  the result is clamped to +-limit, mm
/// @return a field with one plane per position
/// @throws std::invalid_argument on positions out of range or out of order.
/// Cost: O(samples in and out), gaps between slices in parallel; the same bits for any number of threads.
/// Source: Raya, Udupa 1990 (shape-based interpolation).
DenseField interpolateSlices(const DenseField& slices, double sliceSpacing,
                             const std::vector<double>& positions, double limit);

}  // namespace sinew
