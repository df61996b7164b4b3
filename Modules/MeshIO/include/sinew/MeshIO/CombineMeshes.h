#pragma once

#include "sinew/MeshIO/TissueMesh.h"

namespace sinew {

/// Puts meshes into one that holds them side by side: nodes are not shared, regions keep their order. A region whose
/// label an earlier one has taken gets the smallest positive label that none of the meshes uses. Arrays stay that all
/// of them have. Each mesh is freed as soon as it is copied.
TissueMesh combineMeshes(std::vector<TissueMesh> meshes);

}  // namespace sinew
