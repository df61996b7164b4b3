#pragma once

#include "sinew/MeshIO/TissueMesh.h"
#include "sinew/Mesher/SignedDistance.h"

namespace sinew {

/// For every tet `aspect_ratio`, `min_dihedral_deg` and `max_dihedral_deg`, for every node `phi`, the level
/// set there, mm.
/// @param mesh     in LPS mm
/// @param surface  in its own frame
/// @param frame    leads from that frame to LPS
/// Cost: O(tets); parallel.
MeshArrays qualityArrays(const TetMesh& mesh, const SignedDistance& surface, const Eigen::Isometry3d& frame);

}  // namespace sinew
