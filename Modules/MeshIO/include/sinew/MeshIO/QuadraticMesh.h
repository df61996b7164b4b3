#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sinew {

/// The point of a surface next to a point, mm; nothing where there is none near.
using SurfacePoint = std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector3d& x)>;

/// An edge of a mesh whose middle lies off the straight line.
struct CurvedEdge {
  std::array<std::int32_t, 2> nodes;  ///< ascending
  Eigen::Vector3d middle;             ///< mm

  bool operator==(const CurvedEdge&) const = default;
};

/// How the edges of a mesh's boundary bend.
struct CurvedBoundary {
  std::vector<CurvedEdge> edges;       ///< those that bend, ascending by nodes
  std::int64_t boundaryEdges = 0;      ///< all of them
  std::int64_t pulledBackEdges = 0;    ///< bend a half, a quarter or an eighth of the way: a tet would not be valid
  std::int64_t straightenedEdges = 0;  ///< do not bend at all for the same reason
  std::int64_t awayEdges = 0;          ///< do not bend because no surface is near, or at a crease
};

/// Bends the edges of the boundary, each to the point of the surface next to its middle. Where a tet would
/// lose its shape, its edges are pulled back until the determinant of its map is everywhere at least a tenth
/// of that of the straight tet. A surface further away than a quarter of the edge is none of the edge's. Tets
/// that are not positive keep straight edges.
/// @param surface  asked once for each edge, in order, by one thread
/// Cost: O(tets), and the calls.  Source of the bound: Johnen, Remacle, Geuzaine 2013.
CurvedBoundary curveBoundary(const TetMesh& mesh, const SurfacePoint& surface);

/// The same where nothing is known but the mesh: an edge follows the cubic through its ends that is square to
/// the normals there, whose middle is off a sphere by the fourth power of the angle it spans. Edges where the
/// boundary turns by more than 60 degrees are creases: they stay straight, and a normal does not average
/// across them. Source: Vlachos et al. 2001, the edges of curved PN triangles.
CurvedBoundary curveBoundary(const TetMesh& mesh);

/// Corners as in the straight tet, then the middles of the edges kMiddles.
using QuadraticTet = std::array<std::int32_t, 10>;
/// The edges of a tet in the order of their middles: that of VTK, Abaqus, FEBio and Exodus; Gmsh swaps the
/// last two.
inline constexpr std::array<std::array<int, 2>, 6> kMiddles{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

/// The place of the middle of edge (i, j), i != j, in a QuadraticTet.
inline constexpr std::array<std::array<int, 4>, 4> kMiddleOf{
    {{-1, 4, 6, 7}, {4, -1, 5, 8}, {6, 5, -1, 9}, {7, 8, 9, -1}}};

/// Tets of ten nodes.
struct QuadraticMesh {
  std::vector<Eigen::Vector3d> nodes;  ///< those of the straight mesh, then the edges' middles, mm
  std::vector<QuadraticTet> tets;      ///< in the order of the straight mesh
};

/// Adds the middles of all edges. @param curved  ascending by nodes; edges that are not there are straight
/// Cost: O(tets log valence).
QuadraticMesh quadraticMesh(const TetMesh& mesh, const std::vector<CurvedEdge>& curved = {});

/// The Bezier coefficients of the determinant of dx/d(r,s,t), a cubic over the tet: the least is a lower
/// bound, 6 volumes everywhere for a straight tet, and their mean is 6 times the volume.
/// @param nodes  of one tet, in the order of QuadraticTet
std::array<double, 20> jacobianCoefficients(const std::array<Eigen::Vector3d, 10>& nodes);

}  // namespace sinew
