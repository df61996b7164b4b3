#pragma once

#include <cstdint>
#include <vector>

namespace sinew {

/// The two slices of signed distances on either side of a gap, made fit for interpolation (see
/// interpolateSlices): at the height t in [0, 1] the field is
///     (1 - t) lower + t upper - 4 t (1 - t) bulge
/// or, where nothing was changed, a cubic through four slices.
struct SliceGap {
  int nx = 0, ny = 0;
  std::vector<float> lower, upper;    ///< mm, negative inside; signs as given
  std::vector<float> bulge;           ///< mm; empty when it is zero everywhere
  std::vector<std::uint8_t> limited;  ///< 1 where something was changed

  SliceGap(const float* lowerSlice, const float* upperSlice, int nx, int ny);
  /// Finds the parts that move aside, the pieces without counterpart and the lopsided ramps, and changes
  /// them.
  /// @param before,after  the slices below and above the gap's own
  /// @param rounding  depth from the rim beyond which a cap is flat, mm
  void balance(const float* before, const float* after, double rounding);
};

}  // namespace sinew
