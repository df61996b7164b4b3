#pragma once

#include "sinew/LevelSet/SampleLattice.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>
#include <vector>

namespace sinew {

/// A shape given by a formula, in LPS mm.
struct Solid {
  /// Signed distance, mm, negative inside. Where `distance` is false it has the sign and the zero set, and
  /// two values differ by no more than their points are apart: |phi| is at most the distance.
  std::function<double(const Eigen::Vector3d&)> phi;
  Eigen::AlignedBox3d bounds;  ///< of the inside, mm; infinite for a half space
  bool distance = true;        ///< phi is the signed distance
};

// Each throws std::invalid_argument that names the argument and what is allowed. Lengths mm, > 0, finite.
// Distances in closed form: Hart 1996, Quilez.
Solid sphere(const Eigen::Vector3d& center, double radius);
/// phi = (|x/r| - 1) min(r), no distance.
Solid ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii);
/// @param rounding  radius of edges and corners, >= 0, at most half of the shortest side
Solid box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, double rounding = 0);
Solid cylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// The points within `radius` of a segment; a sphere where from = to.
Solid capsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// A cone, cut off where endRadius > 0. @param radius,endRadius  at `from` and `to`, >= 0, not both 0
Solid cone(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, double endRadius = 0);
/// @param radius  of the centre line; @param tube  of the tube around it, < radius
Solid torus(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double radius, double tube);
/// Everything on the side of `point` that `normal` points away from.
Solid halfSpace(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
/// Along a polyline; radii vary linearly from point to point: the union of the convex hulls of consecutive
/// balls. A distance where there are two points, and outside of any tube.
/// @param points  at least two
/// @param radii  one for all points, or one per point
Solid tube(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& radii);
/// Convex hull of at least four points that do not lie in a plane. A distance inside; outside it is that to
/// the planes of the faces. Cost: O(n log n) once, then O(faces) for each evaluation.
/// Source: Barber, Dobkin, Huhdanpaa 1996 (Qhull).
Solid convexHull(const std::vector<Eigen::Vector3d>& points);

/// The solid after a motion, x -> motion * x: a rotation, mirroring or translation that may scale evenly.
/// @throws std::invalid_argument when the motion shears, scales unevenly, or is not finite.
Solid moved(const Solid& solid, const Eigen::Affine3d& motion);

/// A solid on a lattice: a signed distance in the band. Blocks of samples that are all farther from the
/// surface than the band are not evaluated one by one.
/// @param within  LPS box; what of the solid lies outside of it is cut off (needed for infinite solids)
/// @throws std::invalid_argument when the box to sample is infinite, or has more samples than `mostSamples`.
/// Cost: O(samples near the surface) evaluations; in parallel; the same bits for any number of threads.
DenseLevelSet sampleSolid(const Solid& solid, const SampleLattice& lattice, double band,
                          const Eigen::AlignedBox3d& within,
                          std::int64_t mostSamples = std::int64_t{1} << 31);

}  // namespace sinew
