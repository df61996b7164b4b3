#include "sinew/Elasticity/Altitude.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace sinew {

using Eigen::Vector3d;

double Altitude::rate(const NodeVectors& velocities, const Tet& tet) const {
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    sum += weights[i] * normal.dot(velocities[static_cast<std::size_t>(tet[static_cast<std::size_t>(i)])]);
  return sum;
}

Altitude altitude(const NodeVectors& places, const Tet& tet, int corner) {
  const auto place = [&](int i) -> const Vector3d& {
    return places[static_cast<std::size_t>(tet[static_cast<std::size_t>(i)])];
  };
  const std::array<int, 3>& face = kTetFaces[static_cast<std::size_t>(corner)];  // turned outward
  const Vector3d &a = place(face[0]), &b = place(face[1]), &c = place(face[2]), &x = place(corner);
  const Vector3d outward = (b - a).cross(c - a);
  const double twiceArea = outward.norm();
  Altitude result{0, Vector3d::Zero(), Eigen::Vector4d::Zero()};
  result.weights[corner] = 1;
  if (!(twiceArea > 0)) return result;
  const Vector3d inward = -outward / twiceArea;
  result.normal = inward;
  result.height = inward.dot(x - a);
  // Areas over the face's, of the triangles that the foot makes with its edges.
  const auto share = [&](const Vector3d& from, const Vector3d& to) {
    return -(to - from).cross(x - from).dot(inward) / twiceArea;
  };
  result.weights[face[0]] = -share(b, c);
  result.weights[face[1]] = -share(c, a);
  result.weights[face[2]] = -share(a, b);
  return result;
}

double leastAltitude(const NodeVectors& places, const Tet& tet) {
  double least = altitude(places, tet, 0).height;
  for (int corner = 1; corner < 4; ++corner) least = std::min(least, altitude(places, tet, corner).height);
  return least;
}

}  // namespace sinew
