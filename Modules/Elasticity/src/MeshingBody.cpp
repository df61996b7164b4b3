#include "MeshingBody.h"

#include "NodeSums.h"
#include "sinew/Elasticity/Altitude.h"

#include <algorithm>
#include <limits>

namespace sinew {
namespace {

/// Nodes of the boundary and `rings` rings of neighbours.
std::vector<std::uint8_t> nodesNearBoundary(const TetMesh& mesh, int rings) {
  std::vector<std::uint8_t> near(mesh.nodes.size());
  for (std::size_t n = 0; n < near.size(); ++n) near[n] = mesh.kinds[n] == NodeKind::Boundary;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<std::uint8_t> before = near;
    for (const Tet& tet : mesh.tets) {
      const auto isNear = [&](std::int32_t v) { return before[static_cast<std::size_t>(v)] != 0; };
      if (!std::ranges::any_of(tet, isNear)) continue;
      for (const std::int32_t v : tet) near[static_cast<std::size_t>(v)] = 1;
    }
  }
  return near;
}

}  // namespace

MeshingBody meshingBody(const TetMesh& mesh, int rings, double crossing, double modulus) {
  const std::vector<std::uint8_t> near = nodesNearBoundary(mesh, rings);
  MeshingBody part;
  TetMesh moving;
  std::vector<std::int32_t> bodyNode(mesh.nodes.size(), -1);
  for (const Tet& tet : mesh.tets) {
    if (std::ranges::none_of(tet, [&](std::int32_t v) { return near[static_cast<std::size_t>(v)] != 0; }))
      continue;
    Tet local = tet;
    for (std::int32_t& v : local) {
      std::int32_t& node = bodyNode[static_cast<std::size_t>(v)];
      if (node < 0) {
        node = static_cast<std::int32_t>(part.meshNodes.size());
        part.meshNodes.push_back(v);
      }
      v = node;
    }
    moving.tets.push_back(local);
  }
  for (const std::int32_t n : part.meshNodes) {
    const auto node = static_cast<std::size_t>(n);
    if (mesh.kinds[node] == NodeKind::Boundary)
      part.boundary.push_back(static_cast<std::int32_t>(moving.nodes.size()));
    moving.nodes.push_back(mesh.nodes[node]);
    part.moves.push_back(near[node]);
  }
  part.body = elasticBody(moving);
  std::ranges::fill(part.body.masses, 0);
  part.sizes.assign(moving.nodes.size(), std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < moving.tets.size(); ++t) {
    const double size = leastAltitude(moving.nodes, moving.tets[t]), delay = crossing / size;
    for (const std::int32_t v : moving.tets[t]) {
      const auto node = static_cast<std::size_t>(v);
      part.body.masses[node] += modulus * delay * delay * part.body.volumes[t] / 4;
      part.sizes[node] = std::min(part.sizes[node], size);
    }
  }
  return part;
}

}  // namespace sinew
