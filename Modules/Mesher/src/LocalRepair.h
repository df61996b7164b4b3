#pragma once

#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/SignedDistance.h"

#include <functional>

namespace sinew {

struct LocalRepairOptions {
  double edgeLength = 0;         ///< cube size of the lattice at the surface, mm
  std::int32_t label = 1;        ///< of the tets
  Compressor compressor{};       ///< of the whole candidate; empty: compressOntoSurface
  RepairBounds bounds{};         ///< of what is repaired
  std::function<void()> tick{};  ///< called before every round; may throw to stop
};

/// What the repair did.
struct LocalRepairReport {
  int rounds = 0;          ///< in which patches were tried, all at once
  std::int64_t tried = 0;  ///< patches
  std::int64_t accepted = 0;
};

/// Compresses a candidate onto phi = 0 and repairs what stays bad: at every spot where a boundary node cannot
/// reach the surface or a tet stays badly shaped, the candidate gives up nodes nearby or takes one in, and
/// the patch around it is compressed again. A patch that is not better than before is put back as it was, and
/// another change is tried. Patches are far enough apart not to touch, so that a round treats many at once;
/// the result does not depend on the number of threads.
/// @throws std::runtime_error when a boundary node cannot be brought onto the surface
/// Cost: the compression, and O(patch) per trial.
TetMesh compressAndRepair(const LatticeMesh& background, const NodeStars& stars, const Candidate& candidate,
                          const SignedDistance& phi, const LocalRepairOptions& options,
                          LocalRepairReport* report = nullptr);

}  // namespace sinew
