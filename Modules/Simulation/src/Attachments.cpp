#include "sinew/Simulation/Attachments.h"

#include "Numbers.h"
#include "sinew/Mesher/MeshConditions.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Where the mesh lies along a line.
struct Extent {
  double begin = std::numeric_limits<double>::infinity();
  double end = -begin;
  double length() const { return end - begin; }
};

Extent extentAlong(const TetMesh& mesh, const Vector3d& axis) {
  Extent extent;
  for (const Vector3d& x : mesh.nodes) {
    extent.begin = std::min(extent.begin, axis.dot(x));
    extent.end = std::max(extent.end, axis.dot(x));
  }
  return extent;
}

Vector3d middleOf(const TetMesh& mesh, const std::vector<std::int32_t>& nodes) {
  Vector3d sum = Vector3d::Zero();
  for (const std::int32_t node : nodes) sum += mesh.nodes[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

Vector3d longAxis(const TetMesh& mesh) {
  if (mesh.tets.empty()) throw std::invalid_argument("a mesh without tets has no axis");
  // Of a tet of the volume V: integral of x x^T = V/20 (sum x_i x_i^T + (sum x_i) (sum x_i)^T).
  const Vector3d somewhere = mesh.nodes[static_cast<std::size_t>(mesh.tets.front()[0])];
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (const Tet& tet : mesh.tets) {
    Eigen::Matrix<double, 3, 4> x;
    for (int c = 0; c < 4; ++c) x.col(c) = mesh.nodes[static_cast<std::size_t>(tet[c])] - somewhere;
    const double v = (x.rightCols<3>().colwise() - x.col(0)).determinant() / 6;
    const Vector3d sum = x.rowwise().sum();
    volume += v;
    first += v / 4 * sum;
    second += v / 20 * (x * x.transpose() + sum * sum.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(second - first * first.transpose() / volume);
  Vector3d axis = solver.eigenvectors().col(2);
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vector3d(-axis) : axis;
}

void checkShare(double share, double least) {
  if (!(share >= least && share < 0.5))
    throw std::invalid_argument("a share of " + toText(share) + "; it must be " +
                                (least > 0 ? "above 0" : "0 or more") + " and below 0.5");
}

Attachments endsOf(const TetMesh& mesh, double share) {
  checkShare(share, kLeastEnd);
  const Vector3d axis = longAxis(mesh);
  const Extent extent = extentAlong(mesh, axis);
  Attachments ends;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const double place = (axis.dot(mesh.nodes[n]) - extent.begin) / extent.length();
    if (place <= share) ends.insertion.push_back(static_cast<std::int32_t>(n));
    if (place >= 1 - share) ends.origin.push_back(static_cast<std::int32_t>(n));
  }
  return ends;
}

std::vector<std::int32_t> nodesIn(const TetMesh& mesh, const Eigen::AlignedBox3d& box) {
  std::vector<std::int32_t> nodes;
  Eigen::AlignedBox3d own;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    own.extend(mesh.nodes[n]);
    if (box.contains(mesh.nodes[n])) nodes.push_back(static_cast<std::int32_t>(n));
  }
  if (nodes.empty())
    throw std::invalid_argument("no node lies in the box; the mesh lies from " + toText(own.min()) + " to " +
                                toText(own.max()) + " mm");
  return nodes;
}

void checkApart(const Attachments& attachments) {
  std::vector<std::int32_t> origin = attachments.origin, insertion = attachments.insertion, both;
  std::ranges::sort(origin);
  std::ranges::sort(insertion);
  std::ranges::set_intersection(origin, insertion, std::back_inserter(both));
  if (!both.empty())
    throw std::invalid_argument("origin and insertion share " + std::to_string(both.size()) +
                                " nodes; choose attachments that lie apart, or that reach less far");
}

std::vector<double> tendonShares(const TetMesh& mesh, const Attachments& attachments, double share) {
  checkShare(share, kLeastTendon);
  std::vector<double> shares(mesh.tets.size(), 0);
  if (share == 0) return shares;
  const Vector3d axis =
      (middleOf(mesh, attachments.insertion) - middleOf(mesh, attachments.origin)).normalized();
  const Extent extent = extentAlong(mesh, axis);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const Vector3d middle = (mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c] + mesh.nodes[d]) / 4;
    const double place = (axis.dot(middle) - extent.begin) / extent.length();
    const double fromEnd = std::min(place, 1 - place);
    shares[t] = std::clamp(1 - (fromEnd - share) / (share / 2), 0., 1.);
  }
  return shares;
}

double meanBoundaryEdge(const TetMesh& mesh) {
  double sum = 0;
  const std::vector<Triangle> triangles = meshBoundary(mesh).triangles;
  for (const Triangle& triangle : triangles)
    for (std::size_t c = 0; c < 3; ++c)
      sum += (mesh.nodes[static_cast<std::size_t>(triangle[(c + 1) % 3])] -
              mesh.nodes[static_cast<std::size_t>(triangle[c])])
                 .norm();
  return sum / static_cast<double>(3 * triangles.size());
}

}  // namespace sinew
