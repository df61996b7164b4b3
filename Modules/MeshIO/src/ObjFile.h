#pragma once

#include "sinew/MeshIO/TriangleFile.h"

namespace sinew {

/// Reads the vertices (`v`) and polygons (`f`) of a Wavefront .obj file; polygons become fans, everything
/// else is passed over. VTK 9.1 has a reader, which crashes on a damaged file.
/// @throws std::runtime_error naming the file and the line.
/// Source: Wavefront 1992, Advanced Visualizer manual, appendix B1.
TriangleMesh readObj(const std::filesystem::path& file);

}  // namespace sinew
