#pragma once

#include "sinew/MeshIO/TissueMesh.h"

namespace sinew {

/// The tets of one label as a mesh of their own, in their order, with the nodes that they use, their region
/// and their part of all arrays. Curved edges stay behind. `kinds` are those of the nodes in the whole mesh.
TissueMesh regionMesh(const TissueMesh& mesh, std::int32_t label);

}  // namespace sinew
