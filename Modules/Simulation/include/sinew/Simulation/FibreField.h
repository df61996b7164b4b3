#pragma once

#include "sinew/Elasticity/ElasticBody.h"
#include "sinew/Simulation/Attachments.h"

namespace sinew {

/// A fibre for every tet: harmonicFibres() from origin to insertion, and inside of an attachment, where that
/// field is constant, the fibres of the tets around.
/// @return unit vectors; zero in pieces of the mesh without both attachments
/// @throws std::invalid_argument as harmonicFibres() and elasticBody() do
NodeVectors fibreField(const TetMesh& mesh, const Attachments& attachments);

/// Gives each tet without a fibre the mean of those of the tets that share a node with it, layer by layer;
/// vectors that are there are made unit vectors. What nothing reaches stays zero.
/// @throws std::invalid_argument when there is not one fibre for each tet, or one is not finite
/// Cost: O(tets) for each layer.
NodeVectors filledFibres(const TetMesh& mesh, NodeVectors fibres);

}  // namespace sinew
