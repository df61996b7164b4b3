#pragma once

#include "sinew/MeshIO/TriangleFile.h"
#include "sinew/MeshIO/WriteMesh.h"

#include <vector>

namespace sinew {

/// The boundary of one tissue of a mesh.
struct TissueSurface {
  const TissueRegion* region;
  TriangleMesh surface;  ///< in the file's space and unit, outward, without unused nodes
};

/// The surfaces of the tissues that have tets, in the order of the regions, which they refer to. Each is
/// closed: where tissues share faces both have them.
std::vector<TissueSurface> tissueSurfaces(const TissueMesh& mesh, const WriteMeshOptions& options);

}  // namespace sinew
