#pragma once

#include "sinew/Mesher/RedGreenLattice.h"
#include "sinew/Mesher/SignedDistance.h"
#include "sinew/Mesher/Sizing.h"
#include "sinew/Mesher/TetMesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew {

/// Node -> incident tets, in compressed rows, each row ascending.
struct NodeStars {
  std::vector<std::int32_t> offsets;  ///< size nodes + 1
  std::vector<std::int32_t> tets;
  std::span<const std::int32_t> of(std::int32_t node) const {
    return {tets.data() + offsets[node], tets.data() + offsets[node + 1]};
  }
};
/// Cost: O(tets).
NodeStars nodeStars(std::size_t nodes, const std::vector<Tet>& tets);

/// The leaves of a lattice that matter for a shape, with phi at their nodes.
struct LatticeMesh {
  std::vector<Eigen::Vector3d> positions;  ///< mm
  std::vector<double> phi;                 ///< mm, at the nodes
  std::vector<Tet> tets;
  double maxEdge = 0;  ///< longest edge of any tet near the surface, mm
};

/// The leaves that have a node with phi < 2 x their longest edge: the rest lies surely outside (Teran et al.
/// 2005, section 6), and the star of every node with phi < 2 x its shortest incident edge is complete. phi is
/// sampled once per node. Nodes keep the order of the lattice. Cost: O(nodes + tets), parallel.
LatticeMesh latticeMesh(const RedGreenLattice& lattice, const LatticePlan& plan, const SignedDistance& phi);

}  // namespace sinew
