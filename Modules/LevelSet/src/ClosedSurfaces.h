#pragma once

#include "sinew/LevelSet/LevelSetFromTriangles.h"

namespace sinew {

/// A connected closed surface.
struct ClosedSurface {
  std::vector<std::int32_t> triangles;  ///< their numbers, ascending
  double volume = 0;                    ///< that it encloses, mm^3; negative when turned inwards
};

/// The surfaces that triangles form, by the first triangle of each.
/// @throws std::invalid_argument when the triangles are no closed, consistently turned manifold.
/// Cost: O(triangles log triangles).
std::vector<ClosedSurface> closedSurfaces(const TriangleSurface& surface);

}  // namespace sinew
