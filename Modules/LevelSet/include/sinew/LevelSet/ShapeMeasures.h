#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

#include <cstdint>

namespace sinew {

/// Volume of phi < 0, mm^3 (see fieldVolume). Where two surfaces only touch, as after CSG of neighbours, next to
/// nothing is counted.
double shapeVolume(const DenseLevelSet& levelSet);

/// LPS box of phi <= 0, with the zero crossings interpolated along the axes; empty for an empty shape.
Eigen::AlignedBox3d shapeBounds(const DenseLevelSet& levelSet);

/// Centre of volume of phi < 0, LPS mm; NaN for an empty shape.
Eigen::Vector3d shapeCentroid(const DenseLevelSet& levelSet);

/// Pieces of a shape and hollows in it, as the signs of the samples have them.
struct ShapeTopology {
  std::int64_t components = 0;  ///< 26-connected pieces of phi < 0
  std::int64_t cavities = 0;    ///< 6-connected pieces of phi >= 0 that do not reach the border
  bool operator==(const ShapeTopology&) const = default;
};
/// Cost: O(samples).
ShapeTopology shapeTopology(const DenseLevelSet& levelSet);

}  // namespace sinew
