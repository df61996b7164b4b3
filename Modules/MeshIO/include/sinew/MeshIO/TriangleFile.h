#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <filesystem>
#include <vector>

namespace sinew {

/// A surface of triangles.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> nodes;  ///< in the file's own unit, which carries none: mm by convention
  std::vector<Triangle> triangles;     ///< turned as in the file
};

/// Reads the polygons of an .obj, .ply, .stl or .vtp file as triangles: larger ones, taken as convex,
/// become fans; points at the same place become one node, triangles that shrink to a line by that are dropped, and
/// nodes without a triangle too. Normals, textures and materials are passed over.
/// @throws std::runtime_error naming the file when it is missing, damaged or has no polygons.
/// Cost: O(points log points).
TriangleMesh readTriangleMesh(const std::filesystem::path& file);

}  // namespace sinew
