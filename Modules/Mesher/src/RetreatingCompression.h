#pragma once

#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/SignedDistance.h"

namespace sinew {

struct RetreatingCompressionOptions {
  double edgeLength = 0;   ///< cube size of the lattice at the surface, mm
  std::int32_t label = 1;  ///< of the tets
};

/// Compresses a candidate onto phi = 0. Where boundary nodes cannot reach the surface or tets stay bad, the
/// candidate gives way and the surroundings are compressed again; the best mesh on the surface among these is
/// kept.
/// @param retreats  receives the rounds taken
/// @throws std::runtime_error when no round brought every boundary node onto the surface
TetMesh compressWithRetreats(const LatticeMesh& background, const NodeStars& stars, Candidate& candidate,
                             const SignedDistance& phi, const RetreatingCompressionOptions& options,
                             int& retreats);

}  // namespace sinew
