#include "Numbers.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Simulation/Attachments.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unsupported/Eigen/BVH>

namespace sinew {
namespace {

using Eigen::Vector3d;

struct Face {
  std::array<Vector3d, 3> corners;
};

/// Eigen's tree asks for it by this name.
Eigen::AlignedBox3d bounding_box(const Face& face) {
  Eigen::AlignedBox3d box(face.corners[0]);
  for (const Vector3d& corner : face.corners) box.extend(corner);
  return box;
}

using FaceTree = Eigen::KdBVH<double, 3, Face>;

double squaredDistanceToEdge(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const Vector3d edge = b - a;
  const double along = std::clamp((x - a).dot(edge) / edge.squaredNorm(), 0., 1.);
  return (a + along * edge - x).squaredNorm();
}

double squaredDistance(const Vector3d& x, const Face& face) {
  const auto& [a, b, c] = face.corners;
  const Vector3d normal = (b - a).cross(c - a);
  const auto beside = [&](const Vector3d& p, const Vector3d& q) {
    return normal.dot((q - p).cross(x - p)) >= 0;  // on the face's side of the edge from p to q
  };
  if (beside(a, b) && beside(b, c) && beside(c, a)) {
    const double height = normal.dot(x - a);
    return height * height / normal.squaredNorm();
  }
  return std::min(
      {squaredDistanceToEdge(x, a, b), squaredDistanceToEdge(x, b, c), squaredDistanceToEdge(x, c, a)});
}

/// What Eigen's tree minimizes.
struct DistanceFrom {
  using Scalar = double;
  const Vector3d& x;
  double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return box.squaredExteriorDistance(x); }
  double minimumOnObject(const Face& face) const { return squaredDistance(x, face); }
};

FaceTree boundaryTree(const TetMesh& mesh) {
  std::vector<Face> faces;
  for (const auto& [a, b, c] : meshBoundary(mesh).triangles)
    faces.push_back({{mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]}});
  return {faces.begin(), faces.end()};
}

std::vector<std::int32_t> boundaryNodes(const TetMesh& mesh) {
  std::vector<std::int32_t> nodes;
  for (const Triangle& triangle : meshBoundary(mesh).triangles)
    nodes.insert(nodes.end(), triangle.begin(), triangle.end());
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  return nodes;
}

}  // namespace

std::vector<std::int32_t> contactNodes(const TetMesh& mesh, const TetMesh& neighbour,
                                       std::optional<double> distance) {
  const double reach = distance ? *distance : meanBoundaryEdge(mesh);
  const FaceTree tree = boundaryTree(neighbour);
  const std::vector<std::int32_t> nodes = boundaryNodes(mesh);
  std::vector<double> distances(nodes.size());
  tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
    DistanceFrom from{mesh.nodes[static_cast<std::size_t>(nodes[i])]};
    distances[i] = std::sqrt(Eigen::BVMinimize(tree, from));
  });
  std::vector<std::int32_t> contact;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nearest = std::min(nearest, distances[i]);
    if (distances[i] <= reach) contact.push_back(nodes[i]);
  }
  if (contact.empty())
    throw std::invalid_argument("no node lies within " + toText(reach) + " mm; the nearest is " +
                                toText(nearest) + " mm away");
  return contact;
}

}  // namespace sinew
