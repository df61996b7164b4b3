#include "TissueSurfaces.h"

#include "MeshFormatTable.h"
#include "sinew/Mesher/MeshConditions.h"

#include <algorithm>
#include <map>
#include <utility>

namespace sinew {
namespace {

/// The nodes that some cells name, numbered anew in their own order.
class Renumbering {
 public:
  explicit Renumbering(std::size_t nodes) : number_(nodes, kNone) {}

  /// Renames the nodes of the cells. @return the old numbers of the new ones, ascending
  template <class Cell>
  std::vector<std::int32_t> apply(std::vector<Cell>& cells) {
    std::vector<std::int32_t> used;
    for (const Cell& cell : cells)
      for (const std::int32_t node : cell)
        if (number_[node] == kNone) number_[node] = kUsed, used.push_back(node);
    std::ranges::sort(used);
    for (std::size_t n = 0; n < used.size(); ++n) number_[used[n]] = static_cast<std::int32_t>(n);
    for (Cell& cell : cells)
      for (std::int32_t& node : cell) node = number_[node];
    for (const std::int32_t node : used) number_[node] = kNone;
    return used;
  }

 private:
  static constexpr std::int32_t kNone = -1, kUsed = 0;
  std::vector<std::int32_t> number_;
};

/// @param tets  of one tissue
TriangleMesh surfaceOf(const TetMesh& mesh, std::vector<Tet> tets, Renumbering& renumbering,
                       const WriteMeshOptions& options) {
  const std::vector<std::int32_t> nodes = renumbering.apply(tets);
  TetMesh tissue;
  tissue.nodes.resize(nodes.size());
  tissue.tets = std::move(tets);
  TriangleMesh surface{{}, meshBoundary(tissue).triangles};
  for (Triangle& triangle : surface.triangles)
    for (std::int32_t& node : triangle) node = nodes[node];
  for (const std::int32_t node : renumbering.apply(surface.triangles))
    surface.nodes.push_back(inFile(mesh.nodes[node], options));
  return surface;
}

}  // namespace

std::vector<TissueSurface> tissueSurfaces(const TissueMesh& mesh, const WriteMeshOptions& options) {
  std::map<std::int32_t, std::vector<Tet>> tets;
  for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t)
    tets[mesh.mesh.labels[t]].push_back(mesh.mesh.tets[t]);
  Renumbering renumbering(mesh.mesh.nodes.size());
  std::vector<TissueSurface> surfaces;
  for (const TissueRegion& region : mesh.regions)
    if (auto own = tets.extract(region.label))
      surfaces.push_back({&region, surfaceOf(mesh.mesh, std::move(own.mapped()), renumbering, options)});
  return surfaces;
}

}  // namespace sinew
