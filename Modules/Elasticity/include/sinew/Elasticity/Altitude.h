#pragma once

#include "sinew/Elasticity/ElasticBody.h"

namespace sinew {

/// How a node of a tet stands above the plane of the other three.
struct Altitude {
  double height;            ///< signed: negative when the tet is inverted, mm
  Eigen::Vector3d normal;   ///< unit normal of the plane, towards the node in a positive tet
  Eigen::Vector4d weights;  ///< 1 at the node, minus the barycentric coordinates of its foot at the others

  /// Rate of the height for velocities of the tet's nodes: normal . sum weights_i v_i
  double rate(const NodeVectors& velocities, const Tet& tet) const;
};

/// @param corner  place of the node in the tet, 0 to 3. A face without an area has the normal zero.
Altitude altitude(const NodeVectors& places, const Tet& tet, int corner);

/// The least of the four heights, signed, mm.
double leastAltitude(const NodeVectors& places, const Tet& tet);

}  // namespace sinew
