#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <array>
#include <vector>

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

/// Dihedral angles of a tet, degrees; number e lies at the edge opposite to kTetEdges[e].
std::array<double, 6> dihedralAnglesDeg(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// A tet and its value by some measure.
struct RankedTet {
  std::int64_t tet = -1;
  double value = 0;
};

inline constexpr std::size_t kRankedTets = 5;

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
  /// Up to kRankedTets each, the worst first; of equals the first of the mesh.
  std::vector<RankedTet> largestAspectRatios, smallestDihedrals, largestDihedrals;
};
/// Cost: O(tets).
MeshQuality meshQuality(const TetMesh& mesh);

}  // namespace sinew
