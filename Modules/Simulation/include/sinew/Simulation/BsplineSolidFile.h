#pragma once

#include "sinew/Elasticity/BsplineSolid.h"

#include <filesystem>

namespace sinew {

/// Reads the control points of a B-spline solid from a JSON file:
///
///     {"counts": [4, 4, 8], "space": "LPS", "points": [[x, y, z], ...]}
///
/// `counts` are those of control points along u, v and w, w along the fibres; `points` are in mm, u the
/// fastest and w the slowest; `space`, LPS unless given, may be RAS.
/// @throws std::runtime_error naming the file when it is missing, no such JSON, or no BsplineSolid
BsplineSolid readBsplineSolid(const std::filesystem::path& file);

}  // namespace sinew
