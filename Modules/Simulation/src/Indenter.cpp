#include "Indenter.h"

#include "SurfaceLayers.h"
#include "TrialText.h"
#include "sinew/Mesher/MeshConditions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// The boundary's nodes with the sums of the normals around them, by area.
struct Surface {
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> nodes;
  std::vector<Vector3d> normals;  // of all nodes of the mesh

  explicit Surface(const TetMesh& mesh)
      : triangles(meshBoundary(mesh).triangles), normals(mesh.nodes.size(), Vector3d::Zero()) {
    std::vector<bool> found(mesh.nodes.size(), false);
    for (const auto& [a, b, c] : triangles) {
      const auto at = [&](std::int32_t n) -> const Vector3d& {
        return mesh.nodes[static_cast<std::size_t>(n)];
      };
      const Vector3d normal = (at(b) - at(a)).cross(at(c) - at(a));
      for (const std::int32_t n : {a, b, c}) {
        normals[static_cast<std::size_t>(n)] += normal;
        found[static_cast<std::size_t>(n)] = true;
      }
    }
    for (std::size_t n = 0; n < found.size(); ++n)
      if (found[n]) nodes.push_back(static_cast<std::int32_t>(n));
  }
};

struct Interval {
  double least = 1e300, largest = -1e300;
  double size() const { return largest - least; }
};

/// Of the surface around the middle of the axis, along a direction across it.
Interval extentAlong(const TetMesh& mesh, const Surface& surface, const Vector3d& middle,
                     const Vector3d& axis, const Vector3d& direction) {
  constexpr double kSlab = 0.1;  // of the length, either side of the middle
  Interval length, across;
  for (const std::int32_t n : surface.nodes) {
    const double along = (mesh.nodes[static_cast<std::size_t>(n)] - middle).dot(axis);
    length.least = std::min(length.least, along);
    length.largest = std::max(length.largest, along);
  }
  for (const std::int32_t n : surface.nodes) {
    const Vector3d from = mesh.nodes[static_cast<std::size_t>(n)] - middle;
    if (std::abs(from.dot(axis)) > kSlab * length.size()) continue;
    across.least = std::min(across.least, from.dot(direction));
    across.largest = std::max(across.largest, from.dot(direction));
  }
  return across;
}

/// The direction across the axis in which the mesh is thinnest, of 36.
Vector3d thinnestWay(const TetMesh& mesh, const Surface& surface, const Vector3d& middle,
                     const Vector3d& axis) {
  constexpr int kWays = 36;
  const Vector3d first = axis.unitOrthogonal();
  Vector3d best = first;
  double least = 1e300;
  for (int way = 0; way < kWays; ++way) {
    const Vector3d direction = Eigen::AngleAxisd(way * std::numbers::pi / kWays, axis) * first;
    const double size = extentAlong(mesh, surface, middle, axis, direction).size();
    if (size >= least) continue;
    least = size;
    best = direction;
  }
  return best;
}

}  // namespace

Indenter placeIndenter(const TetMesh& mesh, const Vector3d& middle, const Vector3d& axis,
                       const std::optional<Vector3d>& push) {
  const Surface surface(mesh);
  Indenter indenter;
  if (push) {
    const Vector3d across = *push - axis * axis.dot(*push);
    constexpr double kAlong = 1e-6;
    if (!(across.norm() > kAlong * push->norm()))
      throw std::invalid_argument("the push is along the long axis, but must be across it");
    indenter.push = across.normalized();
  } else {
    indenter.push = thinnestWay(mesh, surface, middle, axis);
  }
  indenter.thickness = extentAlong(mesh, surface, middle, axis, indenter.push).size();
  const double radius = indenter.thickness / 2;
  const SurfaceLayers layers(mesh, surface.triangles, indenter.push);
  for (const std::int32_t n : surface.nodes) {
    const Vector3d from = mesh.nodes[static_cast<std::size_t>(n)] - middle;
    const double lateral = (from - indenter.push * indenter.push.dot(from)).norm();
    const double facing = surface.normals[static_cast<std::size_t>(n)].normalized().dot(indenter.push);
    constexpr double kFacing = 0.5;  // within 60 degrees
    if (facing < -kFacing && lateral < radius && !layers.around(n).before) {
      const double cosine = std::cos(std::numbers::pi / 2 * lateral / radius);
      indenter.patch.push_back(n);
      indenter.shares.push_back(cosine * cosine);
    } else if (facing > kFacing && !layers.around(n).after) {
      indenter.bed.push_back(n);
    }
  }
  if (indenter.patch.empty() || indenter.bed.empty())
    throw std::invalid_argument("there is no surface to push or to rest on around " +
                                placeText(middle) + "; give another direction of the push, or a finer mesh");
  return indenter;
}

}  // namespace sinew
