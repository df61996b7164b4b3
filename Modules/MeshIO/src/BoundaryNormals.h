#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <optional>
#include <vector>

namespace sinew {

/// An edge of a surface of triangles.
struct SurfaceEdge {
  std::array<std::int32_t, 2> nodes;  ///< ascending
  /// The surface's normals at the two ends, units; empty at a crease, and where not two triangles meet.
  std::optional<std::array<Eigen::Vector3d, 2>> normals;
};

/// The edges of a surface, ascending by nodes, with the normals at their ends.
/// Triangles that meet without a crease (a turn by more than 60 degrees) around a node share a normal there,
/// the mean of theirs with the weights that make it exact on a sphere.
/// @param triangles  counterclockwise from outside
/// Cost: O(triangles log triangles).  Source: Max 1999.
std::vector<SurfaceEdge> surfaceEdges(const std::vector<Eigen::Vector3d>& nodes,
                                      const std::vector<Triangle>& triangles);

}  // namespace sinew
