#pragma once

#include "sinew/Mesher/SignedDistance.h"
#include "sinew/Mesher/TetMesh.h"

#include <vector>

namespace sinew {

/// The nodes of a mesh after its boundary went from phi = 0 to phi = offset, a small part of an edge away.
///
/// Where a tet would leave the bounds of quality for it, an aspect ratio of 3 and dihedral angles of 30 to 130
/// degrees, or get worse beyond them, its nodes stay where they were: no tet inverts, and the worst of a mesh
/// are as good as before.
///
/// @param mesh    with its boundary on phi = 0, in phi's frame
/// @param offset  outwards, mm
/// Cost: O(tets at the boundary), in parallel; the same for any number of threads.
std::vector<Eigen::Vector3d> moveBoundary(const TetMesh& mesh, const SignedDistance& phi, double offset);

}  // namespace sinew
