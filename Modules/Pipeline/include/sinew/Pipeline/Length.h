#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

namespace sinew {

/// A length as a person writes it: `1.5` or `1.5mm` in millimetres, `2vox` in voxels of the scan at hand.
/// One voxel is the cube root of the voxel volume.
struct Length {
  double value = 0;
  bool inVoxels = false;

  constexpr Length() = default;
  constexpr Length(double millimetres) : value(millimetres) {}
  static constexpr Length voxels(double count) {
    Length length(count);
    length.inVoxels = true;
    return length;
  }
  /// @param voxel  size of one voxel, mm
  constexpr double millimetres(double voxel) const { return inVoxels ? value * voxel : value; }
};

/// @throws std::invalid_argument when the text is no finite number with an optional `mm` or `vox`.
Length parseLength(std::string_view text);
/// `1.5mm` or `2vox`; parseLength reads it back.
std::string toString(Length length);
std::ostream& operator<<(std::ostream& stream, Length length);

}  // namespace sinew
