#pragma once

#include "sinew/Elasticity/ElasticBody.h"

#include <cstdint>

namespace sinew {

/// What a node may not do by itself.
enum class NodeFreedom : std::uint8_t {
  Free,        ///< moves as forces say
  Tangential,  ///< has its prescribed velocity along its normal, and is free across
  Held,        ///< has its prescribed velocity
};

/// One entry per node.
struct NodeConstraints {
  std::vector<NodeFreedom> freedom;
  NodeVectors normals;     ///< unit vectors where Tangential
  NodeVectors velocities;  ///< prescribed, mm/s; their part along the normal where Tangential

  explicit NodeConstraints(std::size_t nodes = 0)
      : freedom(nodes, NodeFreedom::Free),
        normals(nodes, Eigen::Vector3d::Zero()),
        velocities(nodes, Eigen::Vector3d::Zero()) {}

  /// Takes from a vector at a node what forces cannot change there.
  Eigen::Vector3d free(std::size_t node, const Eigen::Vector3d& vector) const {
    switch (freedom[node]) {
      case NodeFreedom::Held:
        return Eigen::Vector3d::Zero();
      case NodeFreedom::Tangential:
        return vector - normals[node] * normals[node].dot(vector);
      case NodeFreedom::Free:
        break;
    }
    return vector;
  }

  /// The velocity with its prescribed part.
  Eigen::Vector3d prescribed(std::size_t node, const Eigen::Vector3d& velocity) const {
    return velocities[node] - free(node, velocities[node]) + free(node, velocity);
  }
};

}  // namespace sinew
