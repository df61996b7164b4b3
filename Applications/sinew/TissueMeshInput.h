#pragma once

#include "sinew/MeshIO/TissueMesh.h"

#include <optional>
#include <string>

namespace sinew {

/// One tissue of a mesh file, for commands that work on one.
struct TissueMeshInput {
  std::string file;
  TissueMesh all;     ///< as the file has it, with its cell arrays
  TissueMesh tissue;  ///< the tets of the tissue; its own region has a name
};

/// @param wish  name or label of the tissue; may be empty when the file has only one
/// @throws std::runtime_error naming the file when it cannot be read, has not that one tissue, or when
/// tets of it are flat or inverted
TissueMeshInput readTissueMesh(const std::string& file, const std::string& wish);

/// The label of a tissue of a mesh, by name (without regard to case) or label; nothing when there is none.
std::optional<std::int32_t> findTissue(const TissueMesh& mesh, const std::string& wish);

}  // namespace sinew
