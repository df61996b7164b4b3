#pragma once

#include "sinew/Mesher/TetMesh.h"

namespace sinew {

inline Eigen::Vector3d tetMiddle(const std::vector<Eigen::Vector3d>& nodes, const Tet& tet) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::int32_t node : tet) sum += nodes[static_cast<std::size_t>(node)];
  return sum / 4;
}

}  // namespace sinew
