#pragma once

#include "sinew/Pipeline/MeshTissues.h"

namespace sinew {

/// The ranked tets of a mesh with their places: largest aspect ratios, smallest and largest dihedral angles.
std::vector<WorstElement> worstElements(const TetMesh& mesh, const MeshQuality& quality);

}  // namespace sinew
