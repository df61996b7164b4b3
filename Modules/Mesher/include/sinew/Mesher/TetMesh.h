#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace sinew {

using Tet = std::array<std::int32_t, 4>;
using Triangle = std::array<std::int32_t, 3>;

enum class NodeKind : std::uint8_t { Interior, Boundary };

/// Faces of a positive tet, seen from outside counterclockwise; face f is opposite to node f.
inline constexpr std::array<std::array<int, 3>, 4> kTetFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// The six edges of a tet; edge e and edge 5 - e are opposite.
inline constexpr std::array<std::array<int, 2>, 6> kTetEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// A tetrahedral mesh. A tet (a,b,c,d) is positive: (b-a)x(c-a).(d-a) > 0.
struct TetMesh {
  std::vector<Eigen::Vector3d> nodes;  ///< mm
  std::vector<Tet> tets;               ///< node indices
  std::vector<std::int32_t> labels;    ///< original label value of each tet, size tets.size()
  std::vector<NodeKind> kinds;         ///< size nodes.size()
};

}  // namespace sinew
