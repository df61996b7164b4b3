#pragma once

#include "sinew/Mesher/SignedDistance.h"
#include "sinew/Mesher/TetMesh.h"

#include <cstdint>
#include <vector>

namespace sinew {

struct CompressionOptions {
  double edgeLength = 0;           ///< cube size of the lattice at the surface, mm, > 0
  double surfaceTolerance = 1e-5;  ///< |phi| of a boundary node at the end, in edge lengths
  int snapSweeps = 16;             ///< rounds of the snap onto the surface before giving up
};

struct CompressionReport {
  std::vector<std::int32_t> unsnapped;  ///< boundary nodes left off the surface; empty in a good mesh
  int snapSweeps = 0;                   ///< rounds taken
};

/// Moves the nodes of a candidate mesh so that its boundary lies on phi = 0 and its tets are well shaped.
///
/// Boundary nodes go along grad phi as far as a rising cap on the shape measure F of their tets allows;
/// between these steps the nodes near the surface and next to green tets descend by Newton steps on the sum
/// of F^q over their tets,
///
///     F = (sum of the six squared edges)^3 / (432 (6V)^2) >= 1,    1 for the regular tet,
///
/// boundary nodes along their level set of phi. Then q rises and the work narrows to the worst stars; a last
/// descent takes the aspect ratio and the dihedral angles themselves. F is a barrier and every step is
/// checked: no tet inverts. Nodes of one colour move at once, so the bits do not depend on the number of
/// threads.
///
/// @param region  flags of the mesh nodes that may move; empty: all near the surface or a green tet
/// Cost: O(surface nodes x sweeps).  Source: the compression of Teran et al. 2005, section 8, with the
/// pattern search replaced by Newton steps on a smooth objective.
CompressionReport compressOntoSurface(TetMesh& mesh, const SignedDistance& phi,
                                      const CompressionOptions& options,
                                      const std::vector<std::uint8_t>& region = {});

}  // namespace sinew
