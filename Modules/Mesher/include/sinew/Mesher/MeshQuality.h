#pragma once

#include "sinew/Mesher/TetMesh.h"

namespace sinew {

/// Quality of one tet.
struct TetQuality {
  double aspectRatio;  ///< longest edge over shortest altitude; regular tet sqrt(3/2), BCC tet sqrt 2; inf if
                       ///< flat
  double minDihedralDeg;
  double maxDihedralDeg;
  double volume;  ///< signed, mm^3
};
TetQuality tetQuality(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d);

/// Quality of a mesh. `inverted` counts tets of volume <= 0.
struct MeshQuality {
  std::int64_t tets = 0;
  std::int64_t nodes = 0;
  double maxAspectRatio = 0;
  double meanAspectRatio = 0;
  double minDihedralDeg = 0;
  double maxDihedralDeg = 0;
  double maxOverMinEdge = 0;  ///< longest over shortest edge of the whole mesh
  double volume = 0;          ///< mm^3
  std::int64_t inverted = 0;
  std::int64_t worstTet = -1;  ///< the tet of the largest aspect ratio
};
/// Cost: O(tets).
MeshQuality meshQuality(const TetMesh& mesh);

}  // namespace sinew
