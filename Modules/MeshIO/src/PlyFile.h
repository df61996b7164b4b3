#pragma once

#include "PlyHeader.h"
#include "sinew/MeshIO/TriangleFile.h"

namespace sinew {

/// Reads the vertices and polygons of a .ply file, ascii or binary of either byte order; polygons become
/// fans, all other elements and properties are passed over. What a header claims costs no memory: only what
/// the file holds does. VTK 9.1 has a reader, which aborts the program on a damaged file.
/// @throws std::runtime_error naming the file.  Source: Turk 1994, the PLY polygon file format.
TriangleMesh readPly(const std::filesystem::path& file);

/// The same of a file's bytes. @throws PlyDamaged.
TriangleMesh parsePly(std::string_view bytes);

}  // namespace sinew
