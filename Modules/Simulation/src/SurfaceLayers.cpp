#include "SurfaceLayers.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Lines through nodes of a regular mesh go through edges and nodes elsewhere: these count as met, within this
/// part of a triangle's size.
constexpr double kOnEdge = 1e-9;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Eigen::AlignedBox2d bounding_box(const SurfaceLayers::Flat& flat) {
  Eigen::AlignedBox2d box(flat.corners[0]);
  for (const Vector2d& corner : flat.corners) box.extend(corner);
  const Vector2d margin = Vector2d::Constant(kOnEdge * box.diagonal().norm());
  return {box.min() - margin, box.max() + margin};
}

/// What Eigen's tree looks for.
struct LineThrough {
  std::int32_t node;
  Vector2d place;
  double depth;
  SurfaceLayers::Around found = {};

  bool intersectVolume(const Eigen::AlignedBox2d& box) const { return box.contains(place); }

  /// @return whether nothing more can be found
  bool intersectObject(const SurfaceLayers::Flat& flat) {
    if (std::ranges::find(flat.nodes, node) != flat.nodes.end()) return false;
    const auto& [a, b, c] = flat.corners;
    const double area = cross(b - a, c - a), size = bounding_box(flat).diagonal().squaredNorm();
    if (std::abs(area) < kOnEdge * size) return false;  // along the way
    const Vector3d weights =
        Vector3d(cross(b - place, c - place), cross(c - place, a - place), cross(a - place, b - place)) /
        area;
    if (weights.minCoeff() < -kOnEdge) return false;
    const double apart = weights.dot(flat.depths) - depth, least = kOnEdge * std::sqrt(size);
    found.before = found.before || apart < -least;
    found.after = found.after || apart > least;
    return found.before && found.after;
  }
};

SurfaceLayers::SurfaceLayers(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Vector3d& way)
    : mesh_(mesh), way_(way) {
  across_.row(0) = way.unitOrthogonal();
  across_.row(1) = way.cross(way.unitOrthogonal());
  std::vector<Flat> flats;
  for (const Triangle& triangle : triangles) {
    Flat flat;
    flat.nodes = triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3d& place = mesh.nodes[static_cast<std::size_t>(triangle[c])];
      flat.corners[c] = across_ * place;
      flat.depths[static_cast<Eigen::Index>(c)] = way.dot(place);
    }
    flats.push_back(flat);
  }
  tree_.init(flats.begin(), flats.end());
}

SurfaceLayers::Around SurfaceLayers::around(std::int32_t node) const {
  const Vector3d& place = mesh_.nodes[static_cast<std::size_t>(node)];
  LineThrough line{node, across_ * place, way_.dot(place)};
  Eigen::BVIntersect(tree_, line);
  return line.found;
}

}  // namespace sinew
