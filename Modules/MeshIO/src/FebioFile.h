#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <filesystem>

namespace sinew {

/// `write` of .feb in the table of formats: an FEBio 4.0 model with everything but a step, boundary
/// conditions and loads. A tissue's tets (tet4 or tet10) are the part of its name, its boundary (tri3 or
/// tri6, counterclockwise from outside) the surface `<name>_surface`; its solid domain has the material of
/// its name, one to be exchanged (neo-Hookean, E = 1, v = 0.3 in the file's units), because FEBio takes no
/// part without one. Nodes and elements are numbered from 1 in the mesh's order. The unit system is mm-N-s,
/// CGS or SI by the unit of length; other units are in the comment alone. Names keep all but the characters
/// with a meaning in FEBio's selections and in XML. Sources: FEBio 4 user manual, chapter 3; FEBio's and
/// FEBio Studio's readers (FEBioMeshSection4, FEBioFormat4).
void writeFebio(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

}  // namespace sinew
