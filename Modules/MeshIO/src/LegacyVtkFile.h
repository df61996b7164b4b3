#pragma once

#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"

namespace sinew {

/// Legacy VTK, version 4.2, binary: most other programs read no newer one. The arrays of tissueGrid; the
/// title holds `SPACE=LPS` or `SPACE=RAS`, where 3D Slicer looks for it. The names of the tissues find no
/// place.
void writeLegacyVtk(const TissueMesh& mesh, const std::filesystem::path& file,
                    const WriteMeshOptions& options);

/// Reads versions 1 to 5.1, as text or bytes: tets, the cell arrays `labels` and `RGB`, others when asked for. VTK 9.1's reader
/// believes what a file says of its cells and arrays, and reads behind its memory.
/// @throws std::runtime_error naming the file
TissueMesh readLegacyVtk(const std::filesystem::path& file, const ReadMeshOptions& options);

}  // namespace sinew
