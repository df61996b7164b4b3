#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <optional>
#include <string>
#include <string_view>

namespace sinew {

/// `Sinew mesh, unit mm, space LPS`: the line by which a file says what its coordinates are. A unit without a
/// name is `0.5 to 1 mm`.
std::string coordinatesNote(const WriteMeshOptions& options);

/// The space and the unit that such a line names; nothing for any other line.
std::optional<WriteMeshOptions> readCoordinatesNote(std::string_view line);

/// Where a point of a file is, LPS mm: what `inFile` does the other way round.
Eigen::Vector3d fromFile(const Eigen::Vector3d& x, const WriteMeshOptions& options);

}  // namespace sinew
