#include "CandidateForces.h"

#include "NodeSums.h"

namespace sinew {
namespace {

/// Of any Young's modulus: scaled to kModulus = lambda + 2 mu.
Lame meshingLame(double poisson) {
  const Lame shape = lame(1, poisson);
  const double scale = kModulus / (shape.lambda + 2 * shape.mu);
  return {scale * shape.mu, scale * shape.lambda};
}

std::unique_ptr<Material> meshingMaterial(MeshingMaterial law, const Lame& moduli) {
  switch (law) {
    case MeshingMaterial::StVenantKirchhoff:
      return stVenantKirchhoff(moduli);
    case MeshingMaterial::Corotated:
      return corotated(moduli);
    case MeshingMaterial::NeoHookean:
      break;
  }
  return neoHookean(moduli);
}

}  // namespace

CandidateForces::CandidateForces(const ElasticBody& body, BoundaryDrive& drive,
                                 const PhysicsCompressionOptions& options)
    : body_(body),
      drive_(drive),
      drag_(options.drag / kCrossing),
      push_(options.push / (kCrossing * kCrossing)) {
  if (options.forces == MeshingForces::Springs) {
    const SpringOptions springs{.damping = options.damping, .crossingTime = kCrossing};
    parts_.push_back(std::make_unique<EdgeSprings>(body, springs));
    parts_.push_back(std::make_unique<AltitudeSprings>(
        body, AltitudeSpringOptions{springs, options.shortestOnly, options.actsBelow}));
    return;
  }
  const Lame moduli = meshingLame(options.poisson);
  material_ = meshingMaterial(options.material, moduli);
  const double delay = options.damping * kCrossing;
  parts_.push_back(
      std::make_unique<FiniteElements>(body, *material_, Damping{delay * moduli.lambda, delay * moduli.mu}));
}

double CandidateForces::energy(const NodeVectors& places) const {
  double sum = 0;
  for (const auto& part : parts_) sum += part->energy(places);
  return sum;
}

void CandidateForces::addForces(const NodeVectors& places, NodeVectors& forces) const {
  for (const auto& part : parts_) part->addForces(places, forces);
  if (push_ > 0) {
    drive_.moveTo(places);
    drive_.addForces(push_, forces);
  }
}

void CandidateForces::moveTo(const NodeVectors& places) {
  for (const auto& part : parts_) part->moveTo(places);
}

void CandidateForces::addDamping(const NodeVectors& velocities, NodeVectors& forces) const {
  for (const auto& part : parts_) part->addDamping(velocities, forces);
  forEachIndex(forces.size(), [&](std::size_t n) { forces[n] -= drag_ * body_.masses[n] * velocities[n]; });
}

}  // namespace sinew
