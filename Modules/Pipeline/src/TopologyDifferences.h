#pragma once

#include "LevelSetSurface.h"
#include "sinew/Pipeline/MeshTissues.h"

#include <vector>

namespace sinew {

/// Where a mesh and the shape phi < 0 differ in topology, and how; the widest first.
///
/// Both are seen at the nodes of the level set's grid, on Kuhn's subdivision of it into tets (as in
/// levelSetTopology). The mesh's set of nodes is changed into the shape's node by node, deepest first, as
/// long as a node is simple: its neighbours in the set are connected, and so are those that are not, so that
/// adding or removing it keeps the topology. What is left are the differences: whole pieces and voids, and of
/// every bridge, sheet, hole or gap its narrowest slice.
///
/// @param mesh   in LPS mm
/// @param frame  from the surface's frame to LPS
/// Cost: O(tets + nodes of the band + d log d) for d nodes on which mesh and shape differ; the same for any
/// number of threads.  Source: Bertrand & Malandain 1994 (simple points), on the 14 neighbours of Kuhn's
/// subdivision.
std::vector<TopologyDifference> topologyDifferences(const TetMesh& mesh, const LevelSetSurface& surface,
                                                    const Eigen::Isometry3d& frame);

/// `piece lost`, `hole closed`, ...
const char* toString(TopologyChange change);

}  // namespace sinew
