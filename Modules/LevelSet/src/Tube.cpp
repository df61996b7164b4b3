#include "SolidParts.h"
#include "sinew/LevelSet/Solid.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace sinew {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The convex hull of two balls, a round cone, in the half plane of its axis: balls at heights 0 and h.
/// Source: Quilez, distance functions.
struct RoundCone {
  Axis axis;
  double height, radius, endRadius;

  double phi(const Vector3d& x) const {
    const Vector2d p = axis(x);
    const double slope = (radius - endRadius) / height;  // sine of the half angle, |slope| < 1
    const double flat = std::sqrt(1 - slope * slope);
    const double along = flat * p.y() - slope * p.x();  // on the side's line, from below to above
    if (along < 0) return p.norm() - radius;
    if (along > flat * height) return (p - Vector2d(0, height)).norm() - endRadius;
    return flat * p.x() + slope * p.y() - radius;
  }
};

/// A ball, or the convex hull of two.
Solid hullOfBalls(const Vector3d& from, double radius, const Vector3d& to, double endRadius) {
  const double height = (to - from).norm();
  if (height <= std::abs(radius - endRadius))  // one holds the other
    return radius > endRadius ? sphere(from, radius) : sphere(to, endRadius);
  const RoundCone roundCone{{from, (to - from) / height}, height, radius, endRadius};
  return {[roundCone](const Vector3d& x) { return roundCone.phi(x); },
          ballBounds(from, radius).merged(ballBounds(to, endRadius))};
}

/// The union of solids that follow each other in space: a tree over their order, with the box of each branch.
/// A solid is not nearer than its box.
class Chain {
 public:
  explicit Chain(std::vector<Solid> solids) : solids_(std::move(solids)) {
    boxes_.resize(2 * solids_.size());
    for (std::size_t n = 0; n < solids_.size(); ++n) boxes_[solids_.size() + n] = solids_[n].bounds;
    for (std::size_t n = solids_.size() - 1; n > 0; --n) boxes_[n] = boxes_[2 * n].merged(boxes_[2 * n + 1]);
  }

  /// min phi
  double operator()(const Vector3d& x) const {
    double least = std::numeric_limits<double>::infinity();
    visit(1, x, least);
    return least;
  }

 private:
  /// Branch n has the branches 2n and 2n+1; the last solids_.size() are the solids.
  void visit(std::size_t n, const Vector3d& x, double& least) const {
    if (n >= solids_.size()) {
      least = std::min(least, solids_[n - solids_.size()].phi(x));
      return;
    }
    std::size_t near = 2 * n, far = 2 * n + 1;
    double toNear = boxes_[near].exteriorDistance(x), toFar = boxes_[far].exteriorDistance(x);
    if (toFar < toNear) {
      std::swap(near, far);
      std::swap(toNear, toFar);
    }
    if (toNear <= least || toNear == 0) visit(near, x, least);
    if (toFar <= least || toFar == 0) visit(far, x, least);
  }

  std::vector<Solid> solids_;
  std::vector<AlignedBox3d> boxes_;
};

}  // namespace

Solid tube(const std::vector<Vector3d>& points, const std::vector<double>& radii) {
  if (points.size() < 2) refuse("tube: needs at least two points, got " + std::to_string(points.size()));
  if (radii.size() != 1 && radii.size() != points.size())
    refuse("tube: needs one radius for all or one for each of the " + std::to_string(points.size()) +
           " points, got " + std::to_string(radii.size()));
  const auto radius = [&](std::size_t n) { return radii.size() == 1 ? radii[0] : radii[n]; };
  AlignedBox3d bounds;
  for (std::size_t n = 0; n < points.size(); ++n) {
    requireFinite(points[n], "tube: point " + std::to_string(n));
    requirePositive(radius(n), "tube: radius " + std::to_string(n));
    bounds.extend(ballBounds(points[n], radius(n)));
  }
  std::vector<Solid> pieces;
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    pieces.push_back(hullOfBalls(points[n], radius(n), points[n + 1], radius(n + 1)));
  const bool distance = pieces.size() == 1;
  return {Chain(std::move(pieces)), bounds, distance};
}

}  // namespace sinew
