#include "Laws.h"
#include "Targets.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/TriangleFile.h"

#include <algorithm>

namespace sinew::fuzz {
namespace {

void requireFinite(const std::vector<Eigen::Vector3d>& nodes) {
  require(std::ranges::all_of(nodes, [](const Eigen::Vector3d& x) { return x.allFinite(); }),
          "a node is nowhere");
}

template <class Cells>
void requireNodesOf(const Cells& cells, std::size_t nodes) {
  for (const auto& cell : cells)
    for (const std::int32_t node : cell)
      require(node >= 0 && static_cast<std::size_t>(node) < nodes, "a cell names a node that is not there");
}

}  // namespace

bool runTriangleMesh(std::string_view bytes, std::string_view extension) {
  const auto mesh = readAs("input" + std::string(extension), bytes, &readTriangleMesh);
  if (!mesh) return false;
  require(!mesh->triangles.empty(), "a mesh without triangles");
  requireFinite(mesh->nodes);
  requireNodesOf(mesh->triangles, mesh->nodes.size());
  std::vector<bool> used(mesh->nodes.size(), false);
  for (const auto& [a, b, c] : mesh->triangles) {
    require(a != b && b != c && c != a, "a triangle is a line");
    used[a] = used[b] = used[c] = true;
  }
  require(std::ranges::find(used, false) == used.end(), "a node has no triangle");
  return true;
}

bool runTetMesh(std::string_view bytes, std::string_view extension) {
  const auto read = [](const std::filesystem::path& file) { return readMesh(file, {.cellArrays = true}); };
  const auto mesh = readAs("input" + std::string(extension), bytes, read);
  if (!mesh) return false;
  const TetMesh& tets = mesh->mesh;
  require(!tets.tets.empty(), "a mesh without tets");
  requireFinite(tets.nodes);
  requireNodesOf(tets.tets, tets.nodes.size());
  require(tets.labels.size() == tets.tets.size() && tets.kinds.size() == tets.nodes.size(),
          "an array has another size");
  for (const MeshArray& array : mesh->arrays.cells)
    require(array.components > 0 &&
                array.values.size() == tets.tets.size() * static_cast<std::size_t>(array.components),
            "a cell array has another size");
  return true;
}

}  // namespace sinew::fuzz
