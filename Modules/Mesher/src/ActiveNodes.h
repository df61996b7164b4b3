#pragma once

#include "NodeStarEnergy.h"
#include "sinew/Mesher/TetMesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// The nodes that may move, their stars, and a colouring in which no two nodes of a tet share a colour, so
/// that all nodes of one colour can move at once. Nodes are named by their place in `nodes`, the active
/// index.
struct ActiveNodes {
  struct Range {
    std::size_t begin, end;
  };

  std::vector<std::int32_t> nodes;    ///< mesh nodes, color by color, ascending in each
  std::vector<std::int32_t> indexOf;  ///< mesh node -> active index, or -1
  std::vector<std::int32_t> offsets;  ///< rows of faces, size nodes + 1
  std::vector<StarFaceNodes> faces;
  std::vector<Range> colors;  ///< of active indices

  std::span<const StarFaceNodes> star(std::int32_t active) const {
    return {faces.data() + offsets[active], faces.data() + offsets[active + 1]};
  }
  std::size_t size() const { return nodes.size(); }
};

/// Nodes within a few rings of the boundary and nodes of irregular (green) tets, as flags per mesh node.
std::vector<std::uint8_t> movableNodes(const TetMesh& mesh);

/// Adds the neighbours of flagged nodes, `rings` times.
void growRings(const TetMesh& mesh, int rings, std::vector<std::uint8_t>& flags);

/// Stars and colours of the flagged nodes. Cost: O(tets).
ActiveNodes activeNodes(const TetMesh& mesh, const std::vector<std::uint8_t>& movable);

}  // namespace sinew
