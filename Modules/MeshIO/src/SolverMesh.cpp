#include "SolverMesh.h"

#include "MeshFormatTable.h"
#include "sinew/Mesher/MeshConditions.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace sinew {
namespace {

/// Collects nodes without repetitions.
class NodeCollector {
 public:
  explicit NodeCollector(std::size_t nodes) : lastRound_(nodes, -1) {}

  void begin() { ++round_, found_.clear(); }
  template <class Cell>
  void add(const Cell& cell) {
    for (const std::int32_t node : cell)
      if (std::exchange(lastRound_[node], round_) != round_) found_.push_back(node);
  }
  /// Ascending.
  std::vector<std::int32_t> found() {
    std::ranges::sort(found_);
    return found_;
  }

 private:
  std::vector<std::int32_t> lastRound_;
  std::int32_t round_ = -1;
  std::vector<std::int32_t> found_;
};

std::vector<SolverPart> partsOf(const TissueMesh& mesh) {
  std::unordered_map<std::int32_t, std::size_t> regionOf;
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) regionOf.try_emplace(mesh.regions[r].label, r);
  std::vector<SolverPart> parts(mesh.regions.size());
  for (std::size_t r = 0; r < parts.size(); ++r) parts[r].region = &mesh.regions[r];
  for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t)
    parts[regionOf.at(mesh.mesh.labels[t])].tets.push_back(static_cast<std::int32_t>(t));
  std::erase_if(parts, [](const SolverPart& part) { return part.tets.empty(); });
  return parts;
}

/// Faces of the part's tets that no other of them has.
/// @param local  scratch, of the size of mesh.nodes
std::vector<TetFace> boundaryOf(const TetMesh& mesh, const SolverPart& part,
                                std::vector<std::int32_t>& local) {
  for (std::size_t n = 0; n < part.nodes.size(); ++n) local[part.nodes[n]] = static_cast<std::int32_t>(n);
  TetMesh own;
  own.nodes.resize(part.nodes.size());
  own.tets.reserve(part.tets.size());
  for (const std::int32_t t : part.tets) {
    Tet tet = mesh.tets[t];
    for (std::int32_t& node : tet) node = local[node];
    own.tets.push_back(tet);
  }
  const std::vector<bool> isBoundary = meshBoundary(own).isBoundary;
  std::vector<TetFace> faces;
  for (std::size_t f = 0; f < isBoundary.size(); ++f)
    if (isBoundary[f]) faces.push_back({part.tets[f / 4], static_cast<int>(f % 4)});
  return faces;
}

}  // namespace

FaceNodes::FaceNodes(std::span<const std::int32_t> tet, int face) : count_(tet.size() == 4 ? 3 : 6) {
  const auto& corners = kTetFaces[face];
  for (int k = 0; k < 3; ++k) {
    nodes_[k] = tet[corners[k]];
    if (count_ == 6) nodes_[3 + k] = tet[kMiddleOf[corners[k]][corners[(k + 1) % 3]]];
  }
}

SolverMesh::SolverMesh(const TissueMesh& mesh, const WriteMeshOptions& options)
    : mesh_(mesh.mesh), options_(options), parts_(partsOf(mesh)) {
  if (options.quadratic) {
    QuadraticMesh quadratic =
        quadraticMesh(mesh_, mesh.curvedEdges.empty() ? curveBoundary(mesh_).edges : mesh.curvedEdges);
    quadraticNodes_ = std::move(quadratic.nodes);
    quadraticTets_ = std::move(quadratic.tets);
  }
  NodeCollector nodes(nodeCount());
  std::vector<std::int32_t> local(mesh_.nodes.size());
  for (SolverPart& part : parts_) {
    nodes.begin();
    for (const std::int32_t t : part.tets) nodes.add(mesh_.tets[t]);
    part.nodes = nodes.found();
    part.boundary = boundaryOf(mesh_, part, local);
    if (quadratic()) {
      for (const std::int32_t t : part.tets) nodes.add(tet(t));
      part.nodes = nodes.found();
    }
    nodes.begin();
    for (const TetFace& boundaryFace : part.boundary) nodes.add(face(boundaryFace));
    part.boundaryNodes = nodes.found();
  }
}

Eigen::Vector3d SolverMesh::node(std::size_t n) const {
  return inFile(quadratic() ? quadraticNodes_[n] : mesh_.nodes[n], options_);
}

std::span<const std::int32_t> SolverMesh::tet(std::size_t t) const {
  if (quadratic()) return quadraticTets_[t];
  return mesh_.tets[t];
}

std::vector<TissueRegion> SolverMesh::regions() const {
  std::vector<TissueRegion> regions;
  for (const SolverPart& part : parts_) regions.push_back(*part.region);
  return regions;
}

std::vector<std::int32_t> SolverMesh::tags() const {
  std::int32_t last = 0;
  for (const SolverPart& part : parts_) last = std::max(last, part.region->label);
  std::vector<std::int32_t> tags;
  for (const SolverPart& part : parts_) tags.push_back(part.region->label > 0 ? part.region->label : ++last);
  return tags;
}

}  // namespace sinew
