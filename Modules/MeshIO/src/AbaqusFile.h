#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <filesystem>

namespace sinew {

/// `write` of .inp in the table of formats: the mesh of an Abaqus or CalculiX model, without material and
/// step, so that it can also be taken in by *INCLUDE. Nodes and elements (C3D4 or C3D10) are numbered from 1
/// in the mesh's order. For a tissue whose name is NAME: ELSET NAME, NSETs NAME_nodes and NAME_boundary,
/// element SURFACE NAME_surface; for all, NSET Nall and ELSET Eall. A name begins with a letter, has letters,
/// digits, `_` and `-`, fits into 80 characters with its ending, and differs from the others also without
/// regard to case; a comment holds the tissue's own. Coordinates have 12 digits: CalculiX reads no more than
/// 20 characters of a number. Sources: CalculiX CrunchiX 2.20 manual, section 7 (*ELEMENT, *NSET, *SURFACE);
/// its readers of these cards.
void writeAbaqus(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

}  // namespace sinew
