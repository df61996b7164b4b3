#pragma once

#include <cstdint>
#include <vector>

namespace sinew {

/// The two slices of signed distances on either side of a gap, made fit for interpolation: where a piece of
/// the changing area has no counterpart, or one far away, the distances are limited (see interpolateSlices).
struct SliceGap {
  int nx = 0, ny = 0;
  std::vector<float> lower, upper;    ///< mm, negative inside; signs as given
  std::vector<std::uint8_t> limited;  ///< 1 where a value was changed: interpolate linearly there

  SliceGap(const float* lowerSlice, const float* upperSlice, int nx, int ny);
  /// @param before,after  the slices below and above the gap's own
  /// @param rounding  depth from the rim beyond which a cap is flat, mm
  void balance(const float* before, const float* after, double rounding);
};

}  // namespace sinew
