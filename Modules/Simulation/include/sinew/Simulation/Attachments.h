#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sinew {

/// The nodes by which a mesh is held: those of a muscle's origin and insertion, or its two ends. No node is
/// in both.
struct Attachments {
  std::vector<std::int32_t> origin, insertion;
};

/// The axis of the least moment of inertia, as a unit vector; its largest component is positive: for an
/// upright tissue it points to the head. Cost: O(tets).
Eigen::Vector3d longAxis(const TetMesh& mesh);

/// Of a length, at each end: for endsOf() and tendonShares().
/// @throws std::invalid_argument unless the share is in [least, 0.5)
void checkShare(double share, double least);
inline constexpr double kLeastEnd = std::numeric_limits<double>::min(), kLeastTendon = 0;

/// The nodes near the two ends of a mesh along its long axis. The origin is the end that the axis points to.
/// @param share  of the length that each end takes, in (0, 0.5)
/// @throws std::invalid_argument when the share is out of range or the mesh has no length
Attachments endsOf(const TetMesh& mesh, double share = 0.1);

/// The boundary nodes that touch a neighbour: they lie within a distance of its boundary. Meshes of
/// neighbours overlap or gape by a part of a voxel.
/// @param distance  mm; the mean edge of the mesh's boundary unless given
/// @throws std::invalid_argument when none does, with the nearest distance
/// Cost: O(nodes log triangles).
std::vector<std::int32_t> contactNodes(const TetMesh& mesh, const TetMesh& neighbour,
                                       std::optional<double> distance = {});

/// The nodes in a box, its faces included.
/// @throws std::invalid_argument when there is none, with the box of the mesh
std::vector<std::int32_t> nodesIn(const TetMesh& mesh, const Eigen::AlignedBox3d& box);

/// @throws std::invalid_argument when origin and insertion share nodes
void checkApart(const Attachments& attachments);

/// The share of tendon of each tet: 1 near the attachments, then falling to 0 over half as much again.
/// @param share  that each tendon takes, in [0, 0.5), of the length of the mesh along the line from the
/// middle of the origin to that of the insertion
/// @throws std::invalid_argument when the share is out of range
std::vector<double> tendonShares(const TetMesh& mesh, const Attachments& attachments, double share);

/// Mean length of the edges of the boundary's triangles, mm.
double meanBoundaryEdge(const TetMesh& mesh);

}  // namespace sinew
