#pragma once

#include "sinew/Elasticity/ElasticForces.h"

namespace sinew {

/// What acts on the nodes of a body: forces by places, and damping that is linear in the velocities.
class ForceModel {
 public:
  virtual ~ForceModel() = default;

  /// uJ
  virtual double energy(const NodeVectors& places) const = 0;
  /// Adds the forces at rest of motion, mN.
  virtual void addForces(const NodeVectors& places, NodeVectors& forces) const = 0;
  /// Keeps what the damping at these places needs, for many calls of addDamping.
  virtual void moveTo(const NodeVectors& places) = 0;
  /// Adds D v, D symmetric and negative semidefinite.
  virtual void addDamping(const NodeVectors& velocities, NodeVectors& forces) const = 0;
};

/// Finite volume forces of a material, with damping of St Venant-Kirchhoff form. Keeps references.
class FiniteElements final : public ForceModel {
 public:
  FiniteElements(const ElasticBody& body, const Material& material, Damping damping = {})
      : body_(body), material_(material), damping_(body, damping) {}

  double energy(const NodeVectors& places) const override { return elasticEnergy(body_, material_, places); }
  void addForces(const NodeVectors& places, NodeVectors& forces) const override {
    addElasticForces(body_, material_, places, forces);
  }
  void moveTo(const NodeVectors& places) override { damping_.moveTo(places); }
  void addDamping(const NodeVectors& velocities, NodeVectors& forces) const override {
    damping_.add(velocities, forces);
  }

 private:
  const ElasticBody& body_;
  const Material& material_;
  DampingForces damping_;
};

}  // namespace sinew
