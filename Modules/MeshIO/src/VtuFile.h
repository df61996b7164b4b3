#pragma once

#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"

namespace sinew {

/// VTK XML unstructured grid: the arrays of tissueGrid, the field data of addMarks. Points are double.
void writeVtu(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);
TissueMesh readVtu(const std::filesystem::path& file, const ReadMeshOptions& options);

}  // namespace sinew
