#pragma once

#include "sinew/MeshIO/TissueMesh.h"

#include <filesystem>

namespace sinew {

struct ReadMeshOptions {
  /// Also the cell arrays of floating point numbers, where the format has them: .vtu and .vtk. Those of three
  /// components are vectors, and turned as coordinates are.
  bool cellArrays = false;
};

/// Reads the tets of a mesh file; the end of its name tells the format, see meshFormats(). Other cells are
/// passed over. Coordinates that the file marks as RAS are turned into LPS. `labels` comes from the cell
/// array of that name, else they are 1; `kinds` from the boundary; names and colours from the file where it
/// has them.
/// @throws std::runtime_error naming the file when it is missing, damaged or has no tets.
TissueMesh readMesh(const std::filesystem::path& file, const ReadMeshOptions& options = {});

}  // namespace sinew
