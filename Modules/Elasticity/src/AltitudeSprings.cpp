#include "NodeSums.h"
#include "SpringParts.h"
#include "sinew/Elasticity/Altitude.h"

#include <Eigen/Geometry>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The harmonic mean of the node's mass and of what resists at the foot.
double springMass(const ElasticBody& body, const Tet& tet, int corner, const Altitude& atRest) {
  double inverse = 0;
  for (int i = 0; i < 4; ++i)
    inverse += atRest.weights[i] * atRest.weights[i] /
               body.masses[static_cast<std::size_t>(tet[static_cast<std::size_t>(i)])];
  const double own = body.masses[static_cast<std::size_t>(tet[static_cast<std::size_t>(corner)])];
  return harmonicMean(own, 1 / (inverse - 1 / own));
}

}  // namespace

AltitudeSprings::AltitudeSprings(const ElasticBody& body, const AltitudeSpringOptions& options)
    : body_(body), options_(options) {
  requireSound(options.springs);
  if (!(options.actsBelow > 0)) throw std::invalid_argument("altitude springs: actsBelow must be positive");
  springs_.resize(body.tets.size());
  for (std::size_t t = 0; t < body.tets.size(); ++t)
    for (int corner = 0; corner < 4; ++corner) {
      const Altitude atRest = altitude(body.rest, body.tets[t], corner);
      const double m = springMass(body, body.tets[t], corner, atRest), length = atRest.height;
      const double stiffness = springRate(options.springs, m, length);
      springs_[t][static_cast<std::size_t>(corner)] = {
          length, stiffness, options.springs.damping * 2 * std::sqrt(stiffness * m)};
    }
}

template <class Function>
void AltitudeSprings::forActing(const NodeVectors& places, std::size_t tet, const Function& f) const {
  std::array<Altitude, 4> altitudes;
  int shortest = 0;
  for (int corner = 0; corner < 4; ++corner) {
    altitudes[static_cast<std::size_t>(corner)] = altitude(places, body_.tets[tet], corner);
    if (altitudes[static_cast<std::size_t>(corner)].height <
        altitudes[static_cast<std::size_t>(shortest)].height)
      shortest = corner;
  }
  for (int corner = 0; corner < 4; ++corner) {
    const Altitude& now = altitudes[static_cast<std::size_t>(corner)];
    const Spring& spring = springs_[tet][static_cast<std::size_t>(corner)];
    if (options_.shortestOnly && corner != shortest) continue;
    if (now.height < options_.actsBelow * spring.length) f(corner, now, spring);
  }
}

double AltitudeSprings::energy(const NodeVectors& places) const {
  return deterministicSum(body_.tets.size(), [&](std::size_t t) {
    double sum = 0;
    forActing(places, t, [&](int, const Altitude& now, const Spring& spring) {
      sum += spring.stiffness * (now.height - spring.length) * (now.height - spring.length) / 2;
    });
    return sum;
  });
}

void AltitudeSprings::addForces(const NodeVectors& places, NodeVectors& forces) const {
  addTetForces(
      body_,
      [&](std::size_t t) {
        TetForces ofTet;
        forActing(places, t, [&](int, const Altitude& now, const Spring& spring) {
          const Vector3d f = -spring.stiffness * (now.height - spring.length) * now.normal;
          for (int i = 0; i < 4; ++i) ofTet.add(i, now.weights[i] * f);
        });
        return ofTet.columns();
      },
      forces);
}

void AltitudeSprings::moveTo(const NodeVectors& places) { places_ = places; }

void AltitudeSprings::addDamping(const NodeVectors& velocities, NodeVectors& forces) const {
  if (options_.springs.damping == 0) return;
  addTetForces(
      body_,
      [&](std::size_t t) {
        TetForces ofTet;
        forActing(places_, t, [&](int, const Altitude& now, const Spring& spring) {
          const Vector3d f = -spring.damping * now.rate(velocities, body_.tets[t]) * now.normal;
          for (int i = 0; i < 4; ++i) ofTet.add(i, now.weights[i] * f);
        });
        return ofTet.columns();
      },
      forces);
}

Matrix3d AltitudeSprings::stress(const NodeVectors& places, std::size_t tet) const {
  Matrix3d sigma = Matrix3d::Zero();
  forActing(places, tet, [&](int corner, const Altitude& now, const Spring& spring) {
    const std::array<int, 3>& face = kTetFaces[static_cast<std::size_t>(corner)];
    const auto place = [&](int i) -> const Vector3d& {
      return places[static_cast<std::size_t>(
          body_.tets[tet][static_cast<std::size_t>(face[static_cast<std::size_t>(i)])])];
    };
    const double area = (place(1) - place(0)).cross(place(2) - place(0)).norm() / 2;
    const double tension = spring.stiffness * (now.height - spring.length);
    sigma += 3 * tension / area * now.normal * now.normal.transpose();
  });
  return sigma;
}

std::size_t AltitudeSprings::actingSprings(const NodeVectors& places) const {
  std::size_t count = 0;
  for (std::size_t t = 0; t < body_.tets.size(); ++t)
    forActing(places, t, [&](int, const Altitude&, const Spring&) { ++count; });
  return count;
}

}  // namespace sinew
