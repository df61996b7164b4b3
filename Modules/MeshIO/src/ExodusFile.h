#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <filesystem>

namespace sinew {

/// `write` of .exo in the table of formats: Exodus II in classic netCDF, for MOOSE, Sierra, ParaView. A
/// tissue is an element block of its name, of TETRA4 or TETRA10, with its label as id, or the first number
/// above all labels where that is below 1; its boundary is the side set `<name>_boundary` of the same id.
/// Nodes keep their order; elements stand by blocks, and elem_num_map has their numbers in the mesh, from 1.
/// The title says the unit and the space. Names of more than 32 bytes need Exodus 5 (2010). VTK's own writer
/// is not used: it puts the date into the file, doubles nodes that tissues share, prints where it cannot
/// write, and does not notice when the disk is full at the end. Source: Sjaardema et al., "Exodus: a finite
/// element data model", SAND 92-2137 (revised 2019), appendix on netCDF.
void writeExodus(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

}  // namespace sinew
