#pragma once

#include "BoundaryDrive.h"
#include "sinew/Elasticity/ForceModel.h"
#include "sinew/Elasticity/PhysicsCompression.h"

#include <memory>

namespace sinew {

inline constexpr double kCrossing = 1;  // s, of a wave through a tet
inline constexpr double kModulus = 1;   // kPa, of waves of pressure

/// What acts on the nodes of a candidate: springs or finite elements, drag, and in the first stage the push of
/// the surface on the boundary nodes.
class CandidateForces final : public ForceModel {
 public:
  /// Keeps references.
  CandidateForces(const ElasticBody& body, BoundaryDrive& drive, const PhysicsCompressionOptions& options);

  void stopPushing() { push_ = 0; }

  double energy(const NodeVectors& places) const override;  ///< that of the push is not in it
  void addForces(const NodeVectors& places, NodeVectors& forces) const override;
  void moveTo(const NodeVectors& places) override;
  void addDamping(const NodeVectors& velocities, NodeVectors& forces) const override;

 private:
  const ElasticBody& body_;
  BoundaryDrive& drive_;
  double drag_, push_;
  std::unique_ptr<Material> material_;
  std::vector<std::unique_ptr<ForceModel>> parts_;
};

}  // namespace sinew
