#pragma once

#include "MeshingBody.h"
#include "sinew/Elasticity/NodeConstraints.h"
#include "sinew/Mesher/SignedDistance.h"

namespace sinew {

/// Drives the boundary nodes of a body towards phi = 0 along the normals of the mesh.
class BoundaryDrive {
 public:
  /// @param mesh  whose part the body is. Keeps references.
  BoundaryDrive(const TetMesh& mesh, const MeshingBody& part, const SignedDistance& phi);

  /// Finds phi and the normals at these places.
  void moveTo(const NodeVectors& places);

  /// Largest |phi| at a node, mm.
  double maxPhi() const;

  /// Adds -strength mass phi n to the boundary nodes.
  void addForces(double strength, NodeVectors& forces) const;

  /// Prescribes velocities along the normals that take the part `share` of phi away in the time dt, but move
  /// no node by more than the part `longest` of the least altitude around it at rest.
  void prescribe(double share, double longest, double dt, NodeConstraints& constraints) const;

  /// Moves the boundary nodes with |phi| at most `farthest` by one Newton step along their normals.
  void project(double farthest, NodeVectors& places) const;

 private:
  struct Place {
    double phi = 0;
    double slope = 1;  ///< of phi along the normal
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };
  Eigen::Vector3d meshNormal(std::size_t k, const NodeVectors& places) const;

  const MeshingBody& part_;
  const SignedDistance& phi_;
  std::vector<std::int32_t> first_;  ///< boundary node k has fans_[first_[k]] up to fans_[first_[k + 1]]
  std::vector<std::array<std::int32_t, 2>> fans_;  ///< the other two nodes of its triangles, in their order
  std::vector<Place> at_;
};

}  // namespace sinew
