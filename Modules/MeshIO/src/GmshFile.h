#pragma once

#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"

#include <filesystem>

namespace sinew {

/// `write` of .msh in the table of formats: Gmsh 2.2, ASCII, which is what FEBio Studio, SOFA and SimNIBS
/// read as well as Gmsh, meshio, MFEM and FEniCSx do. A tissue's tets (4 or 10 nodes) are the physical volume
/// of its name, its boundary triangles (3 or 6 nodes, counterclockwise from outside) the physical surface
/// `<name> boundary`, where solvers hang loads; both tags of both are the label. Gmsh knows positive tags
/// alone: a label below 1 becomes the first number above all labels. Tets keep their order and are numbered
/// from 1, the triangles follow. The unit and the space stand in a section $Comments at the end, which FEBio
/// Studio refuses (it has .feb). Source: Gmsh 4.8 reference manual, "MSH file format version 2 (Legacy)".
void writeGmsh(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

/// `read` of .msh: 2.2, ASCII or binary. Tets of 4 nodes, and the corners of those of 10; other elements are
/// passed over. Labels are the physical tags, or the second tags where the first are 0; names those of the
/// physical volumes. Coordinates are turned and scaled to LPS mm where the file says that Sinew wrote them
/// otherwise.
/// @throws std::runtime_error naming the file when it is damaged or has no tets.
TissueMesh readGmsh(const std::filesystem::path& file, const ReadMeshOptions& options);

}  // namespace sinew
