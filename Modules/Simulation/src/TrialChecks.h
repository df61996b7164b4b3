#pragma once

#include "sinew/Simulation/MeshTrial.h"

namespace sinew {

/// @throws std::invalid_argument naming the tet, the node or the piece, see runTrial()
void checkSetup(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options);

}  // namespace sinew
