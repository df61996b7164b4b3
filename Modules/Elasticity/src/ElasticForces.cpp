#include "sinew/Elasticity/ElasticForces.h"

#include "NodeSums.h"

namespace sinew {
namespace {

using Eigen::Matrix3d;

/// Forces on nodes 1, 2, 3 of a tet under the stress P.
Matrix3d nodeForces(const ElasticBody& body, std::size_t tet, const Matrix3d& P) {
  return -body.volumes[tet] * P * body.inverseEdges[tet].transpose();
}

}  // namespace

double elasticEnergy(const ElasticBody& body, const Material& material, const NodeVectors& places) {
  return deterministicSum(body.tets.size(), [&](std::size_t t) {
    return body.volumes[t] * material.energy(t, deformationGradient(body, places, t));
  });
}

void addElasticForces(const ElasticBody& body, const Material& material, const NodeVectors& places,
                      NodeVectors& forces) {
  addTetForces(
      body,
      [&](std::size_t t) {
        return nodeForces(body, t, material.stress(t, deformationGradient(body, places, t)));
      },
      forces);
}

void addElasticForceChange(const ElasticBody& body, const Material& material, const NodeVectors& places,
                           const NodeVectors& steps, NodeVectors& changes) {
  addTetForces(
      body,
      [&](std::size_t t) {
        return nodeForces(body, t,
                          material.stressChange(t, deformationGradient(body, places, t),
                                                deformationGradient(body, steps, t)));
      },
      changes);
}

DampingForces::DampingForces(const ElasticBody& body, Damping damping)
    : body_(body), damping_(damping), F_(body.tets.size(), Matrix3d::Identity()) {}

void DampingForces::moveTo(const NodeVectors& places) {
  if (damping_.alpha == 0 && damping_.beta == 0) return;
  forEachIndex(F_.size(), [&](std::size_t t) { F_[t] = deformationGradient(body_, places, t); });
}

void DampingForces::add(const NodeVectors& velocities, NodeVectors& forces) const {
  if (damping_.alpha == 0 && damping_.beta == 0) return;
  addTetForces(
      body_,
      [&](std::size_t t) {
        const Matrix3d rate = F_[t].transpose() * deformationGradient(body_, velocities, t);
        const Matrix3d strainRate = (rate + rate.transpose()) / 2;
        const Matrix3d S =
            damping_.alpha * strainRate.trace() * Matrix3d::Identity() + 2 * damping_.beta * strainRate;
        return nodeForces(body_, t, F_[t] * S);
      },
      forces);
}

}  // namespace sinew
