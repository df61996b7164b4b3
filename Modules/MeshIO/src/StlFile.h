#pragma once

#include "sinew/MeshIO/TriangleFile.h"

namespace sinew {

/// Reads the facets of an .stl file, ascii or binary; three nodes each, which the caller welds. Normals are
/// passed over. What a header claims costs no memory: only what the file holds does.
/// @throws std::runtime_error naming the file.
/// Source: 3D Systems 1988, StereoLithography interface specification.
TriangleMesh readStl(const std::filesystem::path& file);

}  // namespace sinew
