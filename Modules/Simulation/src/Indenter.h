#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <optional>

namespace sinew {

/// A soft round tool at the surface of a mesh, and the bed that the mesh lies in.
struct Indenter {
  Eigen::Vector3d push = Eigen::Vector3d::Zero();  ///< unit vector, into the mesh
  double thickness = 0;                            ///< of the mesh along it, mm
  std::vector<std::int32_t> patch;                 ///< boundary nodes that it pushes
  std::vector<double> shares;     ///< of the depth, for each: cos^2(pi r / 2 R) at r from its middle
  std::vector<std::int32_t> bed;  ///< boundary nodes opposite, which stay
};

/// An indenter of the radius R of half the thickness, whose line goes through `middle` across `axis`. It pushes
/// the surface that lines along the push meet first, and the bed is what they meet last: the walls of a cavity
/// are neither.
/// @param push  across the axis as far as it goes; the way through the mesh that is shortest unless given
/// @throws std::invalid_argument when the line meets no surface, or a push is along the axis
Indenter placeIndenter(const TetMesh& mesh, const Eigen::Vector3d& middle, const Eigen::Vector3d& axis,
                       const std::optional<Eigen::Vector3d>& push);

}  // namespace sinew
