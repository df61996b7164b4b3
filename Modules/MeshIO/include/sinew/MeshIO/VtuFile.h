#pragma once

#include "sinew/MeshIO/TissueMesh.h"

#include <filesystem>

namespace sinew {

/// Writes a mesh as VTK XML unstructured grid: points (double, LPS mm), tets, cell array `labels` (Int32,
/// active scalars), further arrays (Float32) after it, zlib-compressed, readable by ParaView, 3D Slicer and
/// meshio.
/// @throws std::runtime_error naming the file when it cannot be written; std::invalid_argument when an array
/// has not one value for each tet or node.
void writeVtu(const TetMesh& mesh, const std::filesystem::path& file, const MeshArrays& further = {});

/// Reads the tets of a .vtu or .vtk file; other cells are passed over. `labels` comes from the cell array of
/// that name, else 1; `kinds` from the boundary.
/// @throws std::runtime_error naming the file when it is missing, damaged or has no tets.
TetMesh readTetMesh(const std::filesystem::path& file);

}  // namespace sinew
