#pragma once

#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/TetBounds.h"

namespace sinew {

struct MendReport {
  std::int64_t tets = 0;   ///< that were beyond the bounds
  std::int64_t nodes = 0;  ///< that were free to move
  CompressionReport compression;
};

/// Compresses again where a compressed mesh has a tet beyond the bounds or a boundary node off the surface:
/// the nodes within two rings may move, all others stay.
/// @param mesh  with positive tets only
/// Cost: O(tets) to look, and compressOntoSurface of what moves.
MendReport mendCompression(TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& options,
                           const TetBounds& bounds);

}  // namespace sinew
