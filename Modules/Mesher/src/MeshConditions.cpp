#include "sinew/Mesher/MeshConditions.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace sinew {
namespace {

/// The nodes of an edge or a face without their order: the smallest, and the others as one number.
struct Key {
  std::int32_t smallest;
  std::uint64_t others;
};

Key faceKey(std::int32_t a, std::int32_t b, std::int32_t c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, std::uint64_t(b) << 32 | std::uint32_t(c)};
}

Key edgeKey(std::int32_t a, std::int32_t b) {
  const auto [low, high] = std::minmax({a, b});
  return {low, std::uint64_t(high)};
}

/// Calls visit(items) for every group of items with equal keys; groups by key, items ascending.
/// Counting sort by the smallest node, then one short sort per node: O(items) for meshes of bounded valence.
template <class KeyOf, class Visit>
void forEachGroup(std::size_t nodeCount, std::size_t itemCount, const KeyOf& keyOf, const Visit& visit) {
  std::vector<std::int64_t> end(nodeCount + 1, 0);  // becomes the end of each node's bucket
  for (std::size_t i = 0; i < itemCount; ++i) ++end[keyOf(i).smallest + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::uint32_t> buckets(itemCount);
  for (std::size_t i = 0; i < itemCount; ++i) buckets[end[keyOf(i).smallest]++] = std::uint32_t(i);

  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
  std::vector<std::uint32_t> group;
  std::int64_t begin = 0;
  for (std::size_t node = 0; node < nodeCount; begin = end[node++]) {
    sorted.clear();
    for (std::int64_t i = begin; i < end[node]; ++i)
      sorted.emplace_back(keyOf(buckets[i]).others, buckets[i]);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      group.push_back(sorted[i].second);
      if (i + 1 < sorted.size() && sorted[i + 1].first == sorted[i].first) continue;
      visit(std::span<const std::uint32_t>(group));
      group.clear();
    }
  }
}

/// Face 4 t + f is face f of tet t.
Triangle faceNodes(const TetMesh& mesh, std::size_t face) {
  const Tet& tet = mesh.tets[face / 4];
  const auto& [i, j, k] = kTetFaces[face % 4];
  return {tet[i], tet[j], tet[k]};
}

template <class Visit>
void forEachFace(const TetMesh& mesh, const Visit& visit) {
  const auto keyOf = [&](std::size_t face) {
    const auto [a, b, c] = faceNodes(mesh, face);
    return faceKey(a, b, c);
  };
  forEachGroup(mesh.nodes.size(), 4 * mesh.tets.size(), keyOf, visit);
}

std::vector<bool> nodesOf(const std::vector<Triangle>& triangles, std::size_t nodeCount) {
  std::vector<bool> has(nodeCount, false);
  for (const Triangle& triangle : triangles)
    for (const std::int32_t node : triangle) has[node] = true;
  return has;
}

/// Disjoint sets with path halving; the smallest member is the root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    parent_[high] = low;
  }
  std::int64_t count() const {
    std::int64_t roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) roots += parent_[i] == i;
    return roots;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Edge 3 t + k of triangle t runs from its corner k to the next one.
std::pair<std::int32_t, std::int32_t> edgeNodes(const std::vector<Triangle>& triangles, std::size_t edge) {
  const Triangle& triangle = triangles[edge / 3];
  return {triangle[edge % 3], triangle[(edge + 1) % 3]};
}

/// Joins the corners 3 t + k of two triangles that lie at the same ends of a shared edge: connected corners
/// are a fan.
void joinCorners(DisjointSets& fans, const std::vector<Triangle>& triangles, std::uint32_t edge,
                 std::uint32_t other) {
  const auto next = [](std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  const bool sameDirection = edgeNodes(triangles, edge).first == edgeNodes(triangles, other).first;
  fans.join(edge, sameDirection ? other : next(other));
  fans.join(next(edge), sameDirection ? next(other) : other);
}

/// The edges of tets that join two boundary nodes, with repetitions.
std::vector<std::array<std::int32_t, 2>> edgesBetween(const TetMesh& mesh,
                                                      const std::vector<bool>& onBoundary) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const Tet& tet : mesh.tets)
    for (const auto& [i, j] : kTetEdges)
      if (onBoundary[tet[i]] && onBoundary[tet[j]]) edges.push_back({tet[i], tet[j]});
  return edges;
}

/// T1 and T3: walks the boundary's edges together with the tets' edges between boundary nodes.
void checkEdges(const TetMesh& mesh, const std::vector<Triangle>& triangles,
                const std::vector<bool>& onBoundary, MeshConditions& found) {
  const std::size_t boundaryEdges = 3 * triangles.size();
  const auto tetEdges = edgesBetween(mesh, onBoundary);
  const auto keyOf = [&](std::size_t item) {
    if (item >= boundaryEdges)
      return edgeKey(tetEdges[item - boundaryEdges][0], tetEdges[item - boundaryEdges][1]);
    const auto [a, b] = edgeNodes(triangles, item);
    return edgeKey(a, b);
  };
  DisjointSets fans(3 * triangles.size());
  std::vector<bool> bad(mesh.nodes.size(), false);
  forEachGroup(mesh.nodes.size(), boundaryEdges + tetEdges.size(), keyOf,
               [&](std::span<const std::uint32_t> items) {
                 const auto isBoundary = [&](std::uint32_t item) { return item < boundaryEdges; };
                 const auto inTriangles = std::count_if(items.begin(), items.end(), isBoundary);
                 if (inTriangles == 0) ++found.interiorEdgesBetweenBoundaryNodes;
                 for (std::ptrdiff_t i = 1; i < inTriangles; ++i)
                   joinCorners(fans, triangles, items[i - 1], items[i]);
                 if (inTriangles == 0 || inTriangles == 2) return;
                 ++found.nonmanifoldEdges;
                 const auto [a, b] = edgeNodes(triangles, items.front());
                 bad[a] = bad[b] = true;
               });

  std::vector<bool> hasFan(mesh.nodes.size(), false);
  for (std::uint32_t corner = 0; corner < boundaryEdges; ++corner) {
    if (fans.root(corner) != corner) continue;
    const std::int32_t node = triangles[corner / 3][corner % 3];
    if (hasFan[node]) bad[node] = true;
    hasFan[node] = true;
  }
  found.nonmanifoldNodes = std::count(bad.begin(), bad.end(), true);
}

/// T2, and the interior faces that boundary nodes span.
void checkTets(const TetMesh& mesh, const std::vector<bool>& isBoundary, const std::vector<bool>& onBoundary,
               MeshConditions& found) {
  std::int64_t facesSeenFromBothSides = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto onSurface = [&](std::int32_t node) { return bool(onBoundary[node]); };
    const auto boundaryNodes = std::count_if(mesh.tets[t].begin(), mesh.tets[t].end(), onSurface);
    if (boundaryNodes == 4) ++found.tetsWithFourBoundaryNodes;
    for (std::size_t f = 0; f < 4 && boundaryNodes >= 3; ++f) {
      const Triangle nodes = faceNodes(mesh, 4 * t + f);
      if (!isBoundary[4 * t + f] && std::all_of(nodes.begin(), nodes.end(), onSurface))
        ++facesSeenFromBothSides;
    }
  }
  found.interiorFacesWithThreeBoundaryNodes = facesSeenFromBothSides / 2;
}

/// Pieces and V - E + F of a triangle surface; closed where every edge has two triangles.
void measureBoundary(const std::vector<Triangle>& triangles, std::size_t nodeCount, MeshTopology& topology) {
  const auto keyOf = [&](std::size_t edge) {
    const auto [a, b] = edgeNodes(triangles, edge);
    return edgeKey(a, b);
  };
  DisjointSets pieces(triangles.size());
  std::int64_t edgeCount = 0;
  forEachGroup(nodeCount, 3 * triangles.size(), keyOf, [&](std::span<const std::uint32_t> edges) {
    ++edgeCount;
    for (std::size_t i = 1; i < edges.size(); ++i) pieces.join(edges[i - 1] / 3, edges[i] / 3);
  });
  const std::vector<bool> has = nodesOf(triangles, nodeCount);
  topology.boundaryComponents = pieces.count();
  topology.eulerCharacteristic = std::count(has.begin(), has.end(), true) - edgeCount + std::ssize(triangles);
}

}  // namespace

MeshBoundary meshBoundary(const TetMesh& mesh) {
  MeshBoundary boundary;
  boundary.isBoundary.resize(4 * mesh.tets.size());
  DisjointSets pieces(mesh.tets.size());
  forEachFace(mesh, [&](std::span<const std::uint32_t> faces) {
    if (faces.size() == 1) boundary.isBoundary[faces.front()] = true;
    if (faces.size() > 2) ++boundary.facesOfManyTets;
    for (std::size_t i = 1; i < faces.size(); ++i) pieces.join(faces[i - 1] / 4, faces[i] / 4);
  });
  boundary.components = pieces.count();
  for (std::size_t face = 0; face < boundary.isBoundary.size(); ++face)
    if (boundary.isBoundary[face]) boundary.triangles.push_back(faceNodes(mesh, face));
  return boundary;
}

MeshConditions meshConditions(const TetMesh& mesh, const MeshBoundary& boundary) {
  const std::vector<bool> onBoundary = nodesOf(boundary.triangles, mesh.nodes.size());
  MeshConditions found;
  found.facesOfManyTets = boundary.facesOfManyTets;
  checkEdges(mesh, boundary.triangles, onBoundary, found);
  checkTets(mesh, boundary.isBoundary, onBoundary, found);
  return found;
}

MeshTopology meshTopology(const TetMesh& mesh, const MeshBoundary& boundary) {
  MeshTopology topology{.components = boundary.components};
  measureBoundary(boundary.triangles, mesh.nodes.size(), topology);
  return topology;
}

}  // namespace sinew
