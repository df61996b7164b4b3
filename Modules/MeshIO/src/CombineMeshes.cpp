#include "sinew/MeshIO/CombineMeshes.h"

#include <algorithm>
#include <map>
#include <set>

namespace sinew {
namespace {

/// Gives each region a label of its own.
class LabelGiver {
 public:
  explicit LabelGiver(const std::vector<TissueMesh>& meshes) {
    for (const TissueMesh& mesh : meshes)
      for (const TissueRegion& region : mesh.regions) known_.insert(region.label);
  }

  std::int32_t give(std::int32_t wanted) {
    if (given_.insert(wanted).second) return wanted;
    while (known_.contains(next_) || given_.contains(next_)) ++next_;
    given_.insert(next_);
    return next_;
  }

 private:
  std::set<std::int32_t> known_, given_;
  std::int32_t next_ = 1;
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void append(TetMesh& to, const TetMesh& from, const std::map<std::int32_t, std::int32_t>& labels) {
  const auto first = static_cast<std::int32_t>(to.nodes.size());
  append(to.nodes, from.nodes);
  append(to.kinds, from.kinds);
  for (Tet tet : from.tets) {
    for (std::int32_t& node : tet) node += first;
    to.tets.push_back(tet);
  }
  for (const std::int32_t label : from.labels) to.labels.push_back(labels.at(label));
}

/// @param first  the number that the first node of `from` has got
void append(std::vector<CurvedEdge>& to, const std::vector<CurvedEdge>& from, std::size_t first) {
  for (CurvedEdge edge : from) {
    for (std::int32_t& node : edge.nodes) node += static_cast<std::int32_t>(first);
    to.push_back(edge);
  }
}

/// Arrays of these names, still empty, that every mesh has.
std::vector<MeshArray> commonArrays(const std::vector<TissueMesh>& meshes,
                                    std::vector<MeshArray> MeshArrays::*kind) {
  std::vector<MeshArray> common;
  for (const MeshArray& array : meshes.front().arrays.*kind) {
    const auto has = [&](const TissueMesh& mesh) {
      return std::ranges::any_of(mesh.arrays.*kind, [&](const MeshArray& other) {
        return other.name == array.name && other.components == array.components;
      });
    };
    if (std::ranges::all_of(meshes, has)) common.push_back({array.name, {}, array.components});
  }
  return common;
}

void append(std::vector<MeshArray>& to, const std::vector<MeshArray>& from) {
  for (MeshArray& array : to)
    append(array.values, std::ranges::find(from, array.name, &MeshArray::name)->values);
}

void reserve(TetMesh& all, const std::vector<TissueMesh>& meshes) {
  std::size_t nodes = 0, tets = 0;
  for (const TissueMesh& mesh : meshes) {
    nodes += mesh.mesh.nodes.size();
    tets += mesh.mesh.tets.size();
  }
  all.nodes.reserve(nodes);
  all.kinds.reserve(nodes);
  all.tets.reserve(tets);
  all.labels.reserve(tets);
}

}  // namespace

TissueMesh combineMeshes(std::vector<TissueMesh> meshes) {
  if (meshes.empty()) return {};
  if (meshes.size() == 1) return std::move(meshes.front());
  TissueMesh all;
  reserve(all.mesh, meshes);
  all.arrays = {commonArrays(meshes, &MeshArrays::cells), commonArrays(meshes, &MeshArrays::points)};
  LabelGiver giver(meshes);
  for (TissueMesh& mesh : meshes) {
    std::map<std::int32_t, std::int32_t> labels;
    for (TissueRegion& region : mesh.regions) {
      labels[region.label] = giver.give(region.label);
      region.label = labels[region.label];
      all.regions.push_back(std::move(region));
    }
    append(all.curvedEdges, mesh.curvedEdges, all.mesh.nodes.size());
    append(all.mesh, mesh.mesh, labels);
    append(all.arrays.cells, mesh.arrays.cells);
    append(all.arrays.points, mesh.arrays.points);
    mesh = {};
  }
  return all;
}

}  // namespace sinew
