#include "sinew/Elasticity/PhysicsCompression.h"

#include "BoundaryDrive.h"
#include "CandidateForces.h"
#include "NodeSums.h"
#include "sinew/Elasticity/Newmark.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

constexpr int kRings = 2;              // of nodes below the boundary that move
constexpr int kRampSteps = 12;         // of the velocity stage until a step takes all of phi away
constexpr int kProjections = 6;        // Newton steps of the exact fit, at most
constexpr double kCgTolerance = 0.05;  // the damping is soft: a first guess is nearly enough
constexpr double kLongestWay = 0.25;   // of a node in a step, over the least altitude around it
constexpr double kLeastVolume = 0.05;  // over that at rest: tets below give way

/// The share of kCrossing that a step is. Springs are stiffer than the elements: more of them pull at a node.
double stepOf(MeshingForces forces) { return kCrossing * (forces == MeshingForces::Springs ? 0.25 : 0.5); }

void requireThat(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("physics: ") + what);
}

class PhysicsCompressor {
 public:
  PhysicsCompressor(TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& options,
                    const PhysicsCompressionOptions& physics)
      : mesh_(mesh),
        options_(options),
        physics_(physics),
        part_(meshingBody(mesh, kRings, kCrossing, kModulus)),
        drive_(mesh, part_, phi),
        forces_(part_.body, drive_, physics),
        limits_(part_.body, physics.limits),
        constraints_(part_.body.nodeCount()),
        motion_{part_.body.rest, NodeVectors(part_.body.nodeCount(), Eigen::Vector3d::Zero())} {
    for (std::size_t n = 0; n < part_.moves.size(); ++n)
      if (part_.moves[n] == 0) constraints_.freedom[n] = NodeFreedom::Held;
    report_.tets = std::ssize(part_.body.tets);
  }

  PhysicsCompressionReport run() {
    push();
    drag();
    fit();
    giveWay();
    for (std::size_t n = 0; n < part_.meshNodes.size(); ++n)
      mesh_.nodes[static_cast<std::size_t>(part_.meshNodes[n])] = motion_.places[n];
    return report_;
  }

 private:
  double maxPhi() { return drive_.maxPhi() / options_.edgeLength; }

  void step() {
    const double dt = stepOf(physics_.forces);
    const NewmarkOptions newmark{
        .tolerance = kCgTolerance,
        .limit = [&](const NodeVectors& places, double time, NodeVectors& velocities) {
          limits_.apply(constraints_, places, time, velocities);
          slowDown(time, velocities);
        }};
    report_.cgIterations += newmarkStep(part_.body, forces_, constraints_, dt, motion_, newmark).iterations;
    kinetic_ = kineticEnergy(part_.body, motion_.velocities);
    largestKinetic_ = std::max(largestKinetic_, kinetic_);
  }

  /// Tets that the surface crushes stiffen beyond what the step can follow: their nodes may not run away.
  void slowDown(double dt, NodeVectors& velocities) const {
    forEachIndex(velocities.size(), [&](std::size_t n) {
      const double fastest = kLongestWay * part_.sizes[n] / dt, speed = velocities[n].norm();
      if (speed > fastest) velocities[n] *= fastest / speed;
    });
  }

  /// The stage of forces.
  void push() {
    for (; report_.forceSteps < physics_.forceSteps; ++report_.forceSteps) step();
    forces_.stopPushing();
    drive_.moveTo(motion_.places);
    report_.maxPhiAfterForces = maxPhi();
  }

  /// The stage of velocities.
  void drag() {
    while (report_.velocitySteps < physics_.velocitySteps && !report_.converged) {
      ++report_.velocitySteps;
      const double share = std::min(1., static_cast<double>(report_.velocitySteps) / kRampSteps);
      drive_.prescribe(share, physics_.limits.change / 2, stepOf(physics_.forces), constraints_);
      step();
      drive_.moveTo(motion_.places);
      report_.converged = maxPhi() < kNearSurface && kinetic_ <= physics_.stillness * largestKinetic_;
    }
    report_.maxPhi = maxPhi();
    report_.kineticEnergy = largestKinetic_ > 0 ? kinetic_ / largestKinetic_ : 0;
  }

  /// Puts the boundary nodes that are near the surface onto it.
  void fit() {
    for (int k = 0; k < kProjections && drive_.maxPhi() > options_.surfaceTolerance * options_.edgeLength;
         ++k) {
      drive_.project(kNearSurface * options_.edgeLength, motion_.places);
      drive_.moveTo(motion_.places);
    }
  }

  /// Takes the nodes of crushed tets part of the way back to the candidate, until there are none.
  void giveWay() {
    constexpr int kHalvings = 4;  // and then all the way
    std::vector<int> returns(part_.body.nodeCount());
    const NodeVectors& rest = part_.body.rest;
    const NodeVectors reached = motion_.places;
    while (true) {
      std::vector<std::uint8_t> crushed(part_.body.tets.size());
      forEachIndex(crushed.size(), [&](std::size_t t) {
        crushed[t] = deformationGradient(part_.body, motion_.places, t).determinant() < kLeastVolume;
      });
      std::vector<std::uint8_t> back(returns.size());
      for (std::size_t t = 0; t < crushed.size(); ++t)
        if (crushed[t] != 0)
          for (const std::int32_t v : part_.body.tets[t]) back[static_cast<std::size_t>(v)] = 1;
      bool any = false;
      for (std::size_t n = 0; n < back.size(); ++n) {
        if (back[n] == 0 || returns[n] > kHalvings) continue;
        any = true;
        report_.leftBehind += returns[n] == 0;
        const double kept = ++returns[n] > kHalvings ? 0 : std::ldexp(1., -returns[n]);
        motion_.places[n] = rest[n] + kept * (reached[n] - rest[n]);
      }
      if (!any) return;
    }
  }

  TetMesh& mesh_;
  const CompressionOptions& options_;
  const PhysicsCompressionOptions& physics_;
  MeshingBody part_;
  BoundaryDrive drive_;
  CandidateForces forces_;
  StrainLimits limits_;
  NodeConstraints constraints_;
  Motion motion_;
  double kinetic_ = 0, largestKinetic_ = 0;
  PhysicsCompressionReport report_;
};

}  // namespace

void requireSound(const PhysicsCompressionOptions& options) {
  requireThat(options.poisson > -1 && options.poisson < 0.5, "poisson must be in (-1, 0.5)");
  requireThat(options.actsBelow > 0, "acts-below must be positive");
  requireThat(options.damping >= 0, "damping must not be negative");
  requireThat(options.drag >= 0, "drag must not be negative");
  requireThat(options.push > 0, "push must be positive");
  requireThat(options.forceSteps >= 0, "force-steps must not be negative");
  requireThat(options.velocitySteps > 0, "velocity-steps must be positive");
  requireThat(options.stillness > 0, "stillness must be positive");
  requireThat(options.limits.strain > 0 && options.limits.strain < 1, "strain must be in (0, 1)");
  requireThat(options.limits.change > 0, "strain-change must be positive");
  requireThat(options.limits.sweeps > 0, "the sweeps of the limits must be positive");
}

PhysicsCompressionReport compressByPhysics(TetMesh& mesh, const SignedDistance& phi,
                                           const CompressionOptions& options,
                                           const PhysicsCompressionOptions& physics) {
  requireSound(physics);
  if (mesh.tets.empty()) return {};
  return PhysicsCompressor(mesh, phi, options, physics).run();
}

}  // namespace sinew
