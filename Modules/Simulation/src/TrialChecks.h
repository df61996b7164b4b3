#pragma once

#include "sinew/Elasticity/NodeConstraints.h"
#include "sinew/Simulation/MeshTrial.h"

namespace sinew {

/// @throws std::invalid_argument naming the option and what is allowed
void checkOptions(const TrialOptions& options);

/// @throws std::invalid_argument naming the tet, the node or the piece, see runTrial()
void checkSetup(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options);

/// @throws std::invalid_argument when a piece of the mesh has none of the held nodes
void checkHold(const ElasticBody& body, const NodeConstraints& constraints);

}  // namespace sinew
