#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <Eigen/Geometry>

#include <array>
#include <unsupported/Eigen/BVH>
#include <vector>

namespace sinew {

/// The surface of a mesh as lines along a way through it meet it.
class SurfaceLayers {
 public:
  /// @param triangles  of the surface, with nodes of the mesh
  /// @param way  unit vector
  /// Keeps a reference to the mesh.
  SurfaceLayers(const TetMesh& mesh, const std::vector<Triangle>& triangles, const Eigen::Vector3d& way);

  /// Whether the line through a node of the surface meets any of it before the node, or after it. Triangles
  /// along the way do not count, nor those at the node. Cost: O(log(triangles) + those on the line).
  struct Around {
    bool before = false, after = false;
  };
  Around around(std::int32_t node) const;

 private:
  /// A triangle seen along the way.
  struct Flat {
    std::array<Eigen::Vector2d, 3> corners;
    Eigen::Vector3d depths;
    Triangle nodes;
  };
  friend Eigen::AlignedBox2d bounding_box(const Flat& flat);  // Eigen's tree asks for it by this name
  friend struct LineThrough;

  const TetMesh& mesh_;
  Eigen::Matrix<double, 2, 3> across_;
  Eigen::Vector3d way_;
  Eigen::KdBVH<double, 2, Flat> tree_;
};

}  // namespace sinew
