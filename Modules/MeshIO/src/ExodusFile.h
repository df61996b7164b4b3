#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <filesystem>

namespace sinew {

/// `write` of .exo in the table of formats: Exodus II by VTK's writer, for MOOSE, Sierra and others. An
/// element block for each tissue, of 4- or 10-node tets, with its name (the first 32 bytes: Exodus keeps no
/// more) and its label as id, or the first number above all labels where that is below 1. Every block has
/// nodes of its own: tissues that share nodes are parted. The title says the unit and the space. Source:
/// Schoof, Yarberry 1994; vtkExodusIIWriter.
void writeExodus(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

}  // namespace sinew
