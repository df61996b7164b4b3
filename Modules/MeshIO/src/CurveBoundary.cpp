#include "BoundaryNormals.h"
#include "sinew/MeshIO/QuadraticMesh.h"
#include "sinew/Mesher/MeshConditions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr double kLeastJacobian = 0.1;  ///< over the straight tet's
constexpr double kFarthest = 0.25;      ///< of the surface from an edge's middle, over the edge's length
constexpr double kFlat = 1e-9;          ///< the same where the edge need not bend
constexpr int kStraight = 4;            ///< halvings after which an edge is straight

/// An edge that is to bend.
struct Bend {
  std::array<std::int32_t, 2> nodes;
  Eigen::Vector3d straight;  ///< the middle of the straight edge
  Eigen::Vector3d offset;    ///< from there to the surface
  int halvings = 0;          ///< of the offset; kStraight: none is left

  Eigen::Vector3d middle() const {
    return halvings == kStraight ? straight : (straight + std::ldexp(1.0, -halvings) * offset).eval();
  }
};

/// A tet with edges that are to bend.
struct BentTet {
  std::size_t tet;
  std::array<std::int32_t, 6> bends;  ///< of the edges kMiddles; -1: none
};

class Bending {
 public:
  Bending(const TetMesh& mesh, std::vector<Bend> bends) : mesh_(mesh), bends_(std::move(bends)) {
    std::vector<bool> bent(mesh.nodes.size(), false);
    for (const Bend& bend : bends_) bent[bend.nodes[0]] = bent[bend.nodes[1]] = true;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      BentTet found{t, {}};
      for (int e = 0; e < 6; ++e) found.bends[e] = find(bent, mesh.tets[t], kMiddles[e]);
      if (std::ranges::any_of(found.bends, [](std::int32_t b) { return b >= 0; })) tets_.push_back(found);
    }
  }

  /// Halves the bends of tets that are not valid until all are.
  const std::vector<Bend>& settle() {
    std::vector<bool> changed(bends_.size(), true);
    for (bool again = true; again;) {
      std::vector<bool> halve(bends_.size(), false);
      for (const BentTet& tet : tets_)
        if (touches(tet, changed) && !valid(tet))
          for (const std::int32_t b : tet.bends)
            if (b >= 0 && bends_[b].halvings < kStraight) halve[b] = true;
      again = false;
      for (std::size_t b = 0; b < bends_.size(); ++b) {
        bends_[b].halvings += halve[b];
        again = again || halve[b];
      }
      changed = std::move(halve);
    }
    return bends_;
  }

 private:
  std::int32_t find(const std::vector<bool>& bent, const Tet& tet, const std::array<int, 2>& edge) const {
    const auto [low, high] = std::minmax(tet[edge[0]], tet[edge[1]]);
    if (!bent[low] || !bent[high]) return -1;
    const std::array<std::int32_t, 2> nodes{low, high};
    const auto found = std::ranges::lower_bound(bends_, nodes, {}, &Bend::nodes);
    return found != bends_.end() && found->nodes == nodes ? static_cast<std::int32_t>(found - bends_.begin())
                                                          : -1;
  }

  static bool touches(const BentTet& tet, const std::vector<bool>& changed) {
    return std::ranges::any_of(tet.bends, [&](std::int32_t b) { return b >= 0 && changed[b]; });
  }

  bool valid(const BentTet& bent) const {
    const Tet& tet = mesh_.tets[bent.tet];
    std::array<Eigen::Vector3d, 10> nodes;
    for (int i = 0; i < 4; ++i) nodes[i] = mesh_.nodes[tet[i]];
    for (int e = 0; e < 6; ++e)
      nodes[4 + e] = bent.bends[e] >= 0 ? bends_[bent.bends[e]].middle()
                                        : (nodes[kMiddles[e][0]] + nodes[kMiddles[e][1]]) / 2;
    const double straight = (nodes[1] - nodes[0]).cross(nodes[2] - nodes[0]).dot(nodes[3] - nodes[0]);
    return straight > 0 && std::ranges::min(jacobianCoefficients(nodes)) >= kLeastJacobian * straight;
  }

  const TetMesh& mesh_;
  std::vector<Bend> bends_;  ///< ascending by nodes
  std::vector<BentTet> tets_;
};

/// @param target  where the middle of an edge belongs
template <class Target>
CurvedBoundary curve(const TetMesh& mesh, const std::vector<SurfaceEdge>& edges, const Target& target) {
  CurvedBoundary boundary;
  boundary.boundaryEdges = std::ssize(edges);
  std::vector<Bend> bends;
  for (const SurfaceEdge& edge : edges) {
    const Eigen::Vector3d &a = mesh.nodes[edge.nodes[0]], &b = mesh.nodes[edge.nodes[1]];
    const Eigen::Vector3d straight = (a + b) / 2;
    const std::optional<Eigen::Vector3d> middle = target(edge, straight);
    const double bulge = middle ? (*middle - straight).norm() / (b - a).norm() : kFarthest + 1;
    boundary.awayEdges += bulge > kFarthest;
    if (bulge > kFlat && bulge <= kFarthest) bends.push_back({edge.nodes, straight, *middle - straight});
  }
  Bending bending(mesh, std::move(bends));
  for (const Bend& bend : bending.settle()) {
    boundary.pulledBackEdges += bend.halvings > 0 && bend.halvings < kStraight;
    boundary.straightenedEdges += bend.halvings == kStraight;
    if (bend.halvings < kStraight) boundary.edges.push_back({bend.nodes, bend.middle()});
  }
  return boundary;
}

std::vector<SurfaceEdge> boundaryEdges(const TetMesh& mesh) {
  return surfaceEdges(mesh.nodes, meshBoundary(mesh).triangles);
}

}  // namespace

CurvedBoundary curveBoundary(const TetMesh& mesh, const SurfacePoint& surface) {
  return curve(mesh, boundaryEdges(mesh),
               [&](const SurfaceEdge&, const Eigen::Vector3d& straight) { return surface(straight); });
}

CurvedBoundary curveBoundary(const TetMesh& mesh) {
  return curve(
      mesh, boundaryEdges(mesh),
      [&](const SurfaceEdge& edge, const Eigen::Vector3d& straight) -> std::optional<Eigen::Vector3d> {
        if (!edge.normals) return std::nullopt;
        // the middle of the cubic with the control points (2 a + b - ((b - a).n_a) n_a) / 3 and the other
        const Eigen::Vector3d along = mesh.nodes[edge.nodes[1]] - mesh.nodes[edge.nodes[0]];
        const auto& [na, nb] = *edge.normals;
        return straight - (along.dot(na) * na - along.dot(nb) * nb) / 8;
      });
}

}  // namespace sinew
