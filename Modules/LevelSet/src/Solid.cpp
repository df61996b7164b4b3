#include "sinew/LevelSet/Solid.h"

#include "SolidParts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace sinew {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

void requireApart(const Vector3d& from, const Vector3d& to, const std::string& solid) {
  requireFinite(from, solid + ": from");
  requireFinite(to, solid + ": to");
  if (!((to - from).norm() > 0)) refuse(solid + ": from and to must not be the same point");
}

/// Box of a disk with this axis, a unit vector: along e_i it reaches  r sqrt(1 - n_i^2).
AlignedBox3d diskBounds(const Vector3d& center, const Vector3d& axis, double radius) {
  const Vector3d reach = radius * (1 - axis.array().square()).max(0).sqrt();
  return {center - reach, center + reach};
}

/// Distance from p to the segment a-b.
template <class Point>
double segmentDistance(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a, ap = p - a;
  const double squared = ab.squaredNorm();
  const double t = squared > 0 ? std::clamp(ap.dot(ab) / squared, 0.0, 1.0) : 0.0;
  return (ap - t * ab).norm();
}

/// Cut at both ends, flat: the distance to the outline of its section, a trapezoid.
Solid frustum(const Vector3d& from, const Vector3d& to, double radius, double endRadius) {
  const double height = (to - from).norm();
  const Axis axis{from, (to - from) / height};
  const auto phi = [=](const Vector3d& x) {
    const Vector2d p = axis(x), foot(radius, 0), rim(endRadius, height);
    const double outline = std::min({segmentDistance<Vector2d>(p, Vector2d::Zero(), foot),
                                     segmentDistance<Vector2d>(p, foot, rim),
                                     segmentDistance<Vector2d>(p, rim, Vector2d(0, height))});
    const double radiusHere = radius + (endRadius - radius) * p.y() / height;
    const bool inside = p.y() > 0 && p.y() < height && p.x() < radiusHere;
    return inside ? -outline : outline;
  };
  return {phi, diskBounds(from, axis.direction, radius).merged(diskBounds(to, axis.direction, endRadius))};
}

}  // namespace

Solid sphere(const Vector3d& center, double radius) {
  requireFinite(center, "sphere: center");
  requirePositive(radius, "sphere: radius");
  return {[=](const Vector3d& x) { return (x - center).norm() - radius; }, ballBounds(center, radius)};
}

Solid ellipsoid(const Vector3d& center, const Vector3d& radii) {
  requireFinite(center, "ellipsoid: center");
  for (const double radius : radii) requirePositive(radius, "ellipsoid: every radius");
  const double least = radii.minCoeff();
  const auto phi = [=](const Vector3d& x) { return ((x - center).cwiseQuotient(radii).norm() - 1) * least; };
  const bool round = (radii.array() == least).all();
  return {phi, {center - radii, center + radii}, round};
}

Solid box(const Vector3d& min, const Vector3d& max, double rounding) {
  requireFinite(min, "box: min");
  requireFinite(max, "box: max");
  if (!((max - min).array() > 0).all()) refuse("box: min must be below max along every axis");
  requireNotNegative(rounding, "box: rounding");
  const Vector3d center = (min + max) / 2, half = (max - min) / 2;
  if (rounding > half.minCoeff())
    refuse("box: rounding must be at most half of the shortest side, " + std::to_string(half.minCoeff()) +
           ", got " + std::to_string(rounding));
  const Vector3d core = half - Vector3d::Constant(rounding);
  const auto phi = [=](const Vector3d& x) {
    const Vector3d beyond = (x - center).cwiseAbs() - core;
    return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0) - rounding;
  };
  return {phi, {min, max}};
}

Solid cylinder(const Vector3d& from, const Vector3d& to, double radius) {
  requireApart(from, to, "cylinder");
  requirePositive(radius, "cylinder: radius");
  return frustum(from, to, radius, radius);
}

Solid capsule(const Vector3d& from, const Vector3d& to, double radius) {
  requireFinite(from, "capsule: from");
  requireFinite(to, "capsule: to");
  requirePositive(radius, "capsule: radius");
  return {[=](const Vector3d& x) { return segmentDistance(x, from, to) - radius; },
          ballBounds(from, radius).merged(ballBounds(to, radius))};
}

Solid cone(const Vector3d& from, const Vector3d& to, double radius, double endRadius) {
  requireApart(from, to, "cone");
  requireNotNegative(radius, "cone: radius");
  requireNotNegative(endRadius, "cone: endRadius");
  if (radius == 0 && endRadius == 0) refuse("cone: radius and endRadius must not both be 0");
  return frustum(from, to, radius, endRadius);
}

Solid torus(const Vector3d& center, const Vector3d& axis, double radius, double tube) {
  requireFinite(center, "torus: center");
  requireFinite(axis, "torus: axis");
  if (!(axis.norm() > 0)) refuse("torus: axis must not be zero");
  requirePositive(radius, "torus: radius");
  requirePositive(tube, "torus: tube");
  if (!(tube < radius))
    refuse("torus: tube must be smaller than radius, " + std::to_string(radius) + ", got " +
           std::to_string(tube));
  const Axis around{center, axis.normalized()};
  const auto phi = [=](const Vector3d& x) { return (around(x) - Vector2d(radius, 0)).norm() - tube; };
  const AlignedBox3d line = diskBounds(center, around.direction, radius);
  return {phi, {line.min() - Vector3d::Constant(tube), line.max() + Vector3d::Constant(tube)}};
}

Solid halfSpace(const Vector3d& point, const Vector3d& normal) {
  requireFinite(point, "halfSpace: point");
  requireFinite(normal, "halfSpace: normal");
  if (!(normal.norm() > 0)) refuse("halfSpace: normal must not be zero");
  const Vector3d outward = normal.normalized();
  const Vector3d everywhere = Vector3d::Constant(std::numeric_limits<double>::infinity());
  return {[=](const Vector3d& x) { return outward.dot(x - point); }, {-everywhere, everywhere}};
}

}  // namespace sinew
