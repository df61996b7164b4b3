#include "BoundaryDrive.h"

#include "NodeSums.h"
#include "sinew/Mesher/MeshConditions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// Where the mesh normal leans further from grad phi than this, the direction between the two is taken.
constexpr double kLeastSlope = 0.5;

}  // namespace

BoundaryDrive::BoundaryDrive(const TetMesh& mesh, const MeshingBody& part, const SignedDistance& phi)
    : part_(part), phi_(phi), at_(part.boundary.size()) {
  std::vector<std::int32_t> bodyNode(mesh.nodes.size(), -1), place(part.meshNodes.size(), -1);
  for (std::size_t n = 0; n < part.meshNodes.size(); ++n)
    bodyNode[static_cast<std::size_t>(part.meshNodes[n])] = static_cast<std::int32_t>(n);
  for (std::size_t k = 0; k < part.boundary.size(); ++k)
    place[static_cast<std::size_t>(part.boundary[k])] = static_cast<std::int32_t>(k);

  const std::vector<Triangle> triangles = meshBoundary(mesh).triangles;
  const auto forCorners = [&](const auto& f) {
    for (const Triangle& triangle : triangles)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto node = [&](std::size_t i) {
          return bodyNode[static_cast<std::size_t>(triangle[(c + i) % 3])];
        };
        f(static_cast<std::size_t>(place[static_cast<std::size_t>(node(0))]), node(1), node(2));
      }
  };
  first_.assign(part.boundary.size() + 1, 0);
  forCorners([&](std::size_t k, std::int32_t, std::int32_t) { ++first_[k + 1]; });
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  fans_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  forCorners([&](std::size_t k, std::int32_t a, std::int32_t b) {
    fans_[static_cast<std::size_t>(next[k]++)] = {a, b};
  });
}

Vector3d BoundaryDrive::meshNormal(std::size_t k, const NodeVectors& places) const {
  const Vector3d& x = places[static_cast<std::size_t>(part_.boundary[k])];
  Vector3d sum = Vector3d::Zero();
  for (std::int32_t f = first_[k]; f < first_[k + 1]; ++f) {
    const auto [a, b] = fans_[static_cast<std::size_t>(f)];
    sum += (places[static_cast<std::size_t>(a)] - x).cross(places[static_cast<std::size_t>(b)] - x);
  }
  return sum.normalized();
}

void BoundaryDrive::moveTo(const NodeVectors& places) {
  forEachIndex(at_.size(), [&](std::size_t k) {
    Place& at = at_[k];
    Vector3d gradient;
    at.phi = phi_.valueAndGradient(places[static_cast<std::size_t>(part_.boundary[k])], gradient);
    at.normal = meshNormal(k, places);
    at.slope = gradient.dot(at.normal);
    if (at.slope >= kLeastSlope || !(gradient.norm() > kLeastSlope)) return;
    at.normal = (at.normal + gradient.normalized()).normalized();
    at.slope = std::max(gradient.dot(at.normal), kLeastSlope);
  });
}

double BoundaryDrive::maxPhi() const {
  double largest = 0;
  for (const Place& at : at_) largest = std::max(largest, std::abs(at.phi));
  return largest;
}

void BoundaryDrive::addForces(double strength, NodeVectors& forces) const {
  forEachIndex(at_.size(), [&](std::size_t k) {
    const auto node = static_cast<std::size_t>(part_.boundary[k]);
    forces[node] -= strength * part_.body.masses[node] * at_[k].phi * at_[k].normal;
  });
}

void BoundaryDrive::prescribe(double share, double longest, double dt, NodeConstraints& constraints) const {
  forEachIndex(at_.size(), [&](std::size_t k) {
    const auto node = static_cast<std::size_t>(part_.boundary[k]);
    const Place& at = at_[k];
    const double most = longest * part_.sizes[node];
    const double slope = std::max(at.slope, kLeastSlope);
    constraints.freedom[node] = NodeFreedom::Tangential;
    constraints.normals[node] = at.normal;
    constraints.velocities[node] = -std::clamp(share * at.phi / slope, -most, most) / dt * at.normal;
  });
}

void BoundaryDrive::project(double farthest, NodeVectors& places) const {
  forEachIndex(at_.size(), [&](std::size_t k) {
    const Place& at = at_[k];
    if (std::abs(at.phi) > farthest) return;
    places[static_cast<std::size_t>(part_.boundary[k])] -=
        at.phi / std::max(at.slope, kLeastSlope) * at.normal;
  });
}

}  // namespace sinew
