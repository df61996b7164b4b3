#include "sinew/MeshIO/RegionMesh.h"

namespace sinew {
namespace {

/// The values of some items. @param items  ascending
std::vector<MeshArray> taken(const std::vector<MeshArray>& arrays, const std::vector<std::size_t>& items) {
  std::vector<MeshArray> parts;
  for (const MeshArray& array : arrays) {
    const auto size = static_cast<std::size_t>(array.components);
    MeshArray& part = parts.emplace_back(MeshArray{array.name, {}, array.components});
    for (const std::size_t item : items)
      for (std::size_t c = 0; c < size; ++c) part.values.push_back(array.values[item * size + c]);
  }
  return parts;
}

}  // namespace

TissueMesh regionMesh(const TissueMesh& mesh, std::int32_t label) {
  constexpr std::int32_t kUnused = -1;
  TissueMesh part;
  std::vector<std::int32_t> numbers(mesh.mesh.nodes.size(), kUnused);
  std::vector<std::size_t> tets, nodes;
  for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t) {
    if (mesh.mesh.labels[t] != label) continue;
    tets.push_back(t);
    for (const std::int32_t node : mesh.mesh.tets[t]) numbers[static_cast<std::size_t>(node)] = 0;
  }
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    if (numbers[n] == kUnused) continue;
    numbers[n] = static_cast<std::int32_t>(nodes.size());
    nodes.push_back(n);
    part.mesh.nodes.push_back(mesh.mesh.nodes[n]);
    if (!mesh.mesh.kinds.empty()) part.mesh.kinds.push_back(mesh.mesh.kinds[n]);
  }
  for (const std::size_t t : tets) {
    Tet tet = mesh.mesh.tets[t];
    for (std::int32_t& node : tet) node = numbers[static_cast<std::size_t>(node)];
    part.mesh.tets.push_back(tet);
  }
  part.mesh.labels.assign(tets.size(), label);
  for (const TissueRegion& region : mesh.regions)
    if (region.label == label) part.regions.push_back(region);
  part.arrays = {taken(mesh.arrays.cells, tets), taken(mesh.arrays.points, nodes)};
  return part;
}

}  // namespace sinew
