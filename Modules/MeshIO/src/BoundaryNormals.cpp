#include "BoundaryNormals.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace sinew {
namespace {

constexpr double kCreaseCosine = 0.5;  // 60 degrees

/// An edge of one triangle: from its corner k to the next one is number 3 t + k.
struct HalfEdge {
  std::array<std::int32_t, 2> nodes;  ///< ascending
  std::uint32_t number;
};

std::uint32_t nextCorner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// Corners of triangles that are joined share a normal.
class Fans {
 public:
  explicit Fans(std::size_t corners) : parent_(corners) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

class Surface {
 public:
  Surface(const std::vector<Eigen::Vector3d>& nodes, const std::vector<Triangle>& triangles)
      : nodes_(nodes), triangles_(triangles), fans_(3 * triangles.size()) {}

  std::vector<SurfaceEdge> edges() {
    const std::vector<HalfEdge> halves = sortedHalfEdges();
    std::vector<SurfaceEdge> edges;
    std::vector<std::uint32_t> representative;  ///< a half edge of each
    for (std::size_t begin = 0, end = 0; begin < halves.size(); begin = end) {
      while (end < halves.size() && halves[end].nodes == halves[begin].nodes) ++end;
      const bool smooth = end - begin == 2 && joinAcross(halves[begin].number, halves[begin + 1].number);
      edges.push_back({halves[begin].nodes, std::nullopt});
      representative.push_back(smooth ? halves[begin].number : kNone);
    }
    const std::vector<Eigen::Vector3d> normals = fanNormals();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (representative[e] == kNone) continue;
      std::array<std::uint32_t, 2> corners{representative[e], nextCorner(representative[e])};
      if (node(corners[0]) != edges[e].nodes[0]) std::swap(corners[0], corners[1]);
      edges[e].normals = {normals[fans_.root(corners[0])].normalized(),
                          normals[fans_.root(corners[1])].normalized()};
    }
    return edges;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  std::int32_t node(std::uint32_t corner) const { return triangles_[corner / 3][corner % 3]; }
  const Eigen::Vector3d& point(std::uint32_t corner) const { return nodes_[node(corner)]; }

  Eigen::Vector3d normal(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles_[triangle];
    return (nodes_[b] - nodes_[a]).cross(nodes_[c] - nodes_[a]).normalized();
  }

  std::vector<HalfEdge> sortedHalfEdges() const {
    std::vector<HalfEdge> halves(3 * triangles_.size());
    for (std::uint32_t corner = 0; corner < halves.size(); ++corner) {
      const auto [low, high] = std::minmax({node(corner), node(nextCorner(corner))});
      halves[corner] = {{low, high}, corner};
    }
    std::ranges::sort(halves, {}, [](const HalfEdge& h) { return std::pair(h.nodes, h.number); });
    return halves;
  }

  /// Joins the corners at both ends unless the edge is a crease. @return whether they are joined
  bool joinAcross(std::uint32_t half, std::uint32_t other) {
    const bool opposite = node(half) != node(other);  // else the triangles turn against each other
    if (!opposite || normal(half / 3).dot(normal(other / 3)) < kCreaseCosine) return false;
    fans_.join(half, nextCorner(other));
    fans_.join(nextCorner(half), other);
    return true;
  }

  /// n = sum e_i x e_i+1 / (|e_i|^2 |e_i+1|^2), e the edges from the node to its neighbours; at the fans'
  /// roots.
  std::vector<Eigen::Vector3d> fanNormals() {
    std::vector<Eigen::Vector3d> normals(3 * triangles_.size(), Eigen::Vector3d::Zero());
    for (std::uint32_t corner = 0; corner < normals.size(); ++corner) {
      const std::uint32_t next = nextCorner(corner), previous = nextCorner(next);
      const Eigen::Vector3d a = point(next) - point(corner), b = point(previous) - point(corner);
      const double weight = a.squaredNorm() * b.squaredNorm();
      if (weight > 0) normals[fans_.root(corner)] += a.cross(b) / weight;
    }
    return normals;
  }

  const std::vector<Eigen::Vector3d>& nodes_;
  const std::vector<Triangle>& triangles_;
  Fans fans_;
};

}  // namespace

std::vector<SurfaceEdge> surfaceEdges(const std::vector<Eigen::Vector3d>& nodes,
                                      const std::vector<Triangle>& triangles) {
  return Surface(nodes, triangles).edges();
}

}  // namespace sinew
