#pragma once

#include "sinew/MeshIO/TissueMesh.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <Eigen/Geometry>

namespace sinew::test {

/// Two blocks side by side, 4 mm apart, with names that need care and an array of each kind.
inline TissueMesh twoTissues() {
  TissueMesh mesh{
      bccBlock({3, 3, 3}), {{-7, "bone \"left\" <a&b>", {1, 0.5, 0}}, {300, "Müskel", {0.2, 0.4, 0.6}}}, {}};
  TetMesh& tets = mesh.mesh;
  const TetMesh block = tets;
  const auto nodes = static_cast<std::int32_t>(block.nodes.size());
  for (const Eigen::Vector3d& x : block.nodes) tets.nodes.push_back(x + Eigen::Vector3d(7, 0.25, -1));
  for (Tet tet : block.tets) {
    for (std::int32_t& node : tet) node += nodes;
    tets.tets.push_back(tet);
  }
  tets.kinds.insert(tets.kinds.end(), block.kinds.begin(), block.kinds.end());
  tets.labels.assign(block.tets.size(), -7);
  tets.labels.resize(tets.tets.size(), 300);
  mesh.arrays.cells = {{"quality", std::vector<float>(tets.tets.size(), 1.5F)}, {"fibres", {}, 3}};
  for (std::size_t t = 0; t < tets.tets.size(); ++t)
    for (const float component : {0.5F, -0.25F, 1.F}) mesh.arrays.cells[1].values.push_back(component);
  mesh.arrays.points = {{"phi", std::vector<float>(tets.nodes.size(), -2)}};
  return mesh;
}

/// Six times the signed volume of a tet.
inline double sixVolumes(const TetMesh& mesh, const Tet& tet) {
  const Eigen::Vector3d& a = mesh.nodes[tet[0]];
  return (mesh.nodes[tet[1]] - a).cross(mesh.nodes[tet[2]] - a).dot(mesh.nodes[tet[3]] - a);
}

}  // namespace sinew::test
