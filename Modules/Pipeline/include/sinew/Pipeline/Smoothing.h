#pragma once

#include "sinew/Pipeline/Length.h"

#include <string>
#include <string_view>

namespace sinew {

/// How much a tissue's voxels are smoothed on the way to its level set, as a person writes it: `none` keeps
/// their stairs; `light` is the Gauss of one voxel of levelSetFromLabels; a time in mm^2 (`2`, `2mm2`,
/// `2mm^2`) or a length (`1mm`, `2vox`) adds motion by mean curvature that keeps volume and topology (see
/// smooth).
struct Smoothing {
  enum class Kind { None, Light, Time, Length };
  Kind kind = Kind::Light;
  double time = 0;       ///< of the motion by mean curvature, mm^2; Kind::Time
  sinew::Length length;  ///< Kind::Length: dents and bumps about this wide go

  /// Time of the motion by mean curvature, mm^2: for a length L it is L^2/2, in which a Gauss spreads to the
  /// standard deviation L. @param voxel  size of one voxel, mm
  double motion(double voxel) const;
};

/// @throws std::invalid_argument when the text is none of the above, or negative.
Smoothing parseSmoothing(std::string_view text);
/// parseSmoothing reads it back.
std::string toString(const Smoothing& smoothing);

}  // namespace sinew
