#pragma once

#include "sinew/Elasticity/ElasticBody.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace sinew {

/// A solid S(u, v, w) with u, v, w in [0, 1]: the tensor product of clamped uniform B-splines over a grid of
/// control points, cubic where there are four of them or more along a direction, else of the degree that
/// their number allows. A muscle is such a solid with w along its fibres, from origin to insertion.
/// Source: Ng-Thow-Hing and Fiume 2002, Application-specific muscle representations; Teran et al. 2005,
/// section 8.
class BsplineSolid {
 public:
  using Knots = Eigen::Array<double, 1, Eigen::Dynamic>;

  /// @param counts  of control points along u, v, w; at least 2 each
  /// @param points  mm; u is the fastest, w the slowest
  /// @throws std::invalid_argument when a count is too small, there are not as many points as the counts
  /// say, or the solid is folded or flat at one of its samples (three along each direction in every span, away
  /// from the faces: ends may taper to a line or to a point)
  BsplineSolid(const std::array<int, 3>& counts, NodeVectors points);

  struct Place {
    Eigen::Vector3d x;       ///< S, mm
    Eigen::Matrix3d slopes;  ///< columns dS/du, dS/dv, dS/dw, mm
  };
  Place at(const Eigen::Vector3d& parameters) const;

  /// u, v, w of the point of the solid next to x: of x itself where x lies inside. By damped Newton steps
  /// with bounds (Gauss-Newton) from the nearest of some samples.
  /// Cost: O(log samples), of which each span has 125; then some steps.
  Eigen::Vector3d nearest(const Eigen::Vector3d& x) const;

  /// The unit vector along dS/dw at nearest(x); zero where dS/dw is.
  Eigen::Vector3d fibre(const Eigen::Vector3d& x) const;

 private:
  void checkUnfolded() const;
  std::array<int, 3> counts_;
  std::array<Knots, 3> knots_;
  NodeVectors points_;
  struct Samples;
  std::shared_ptr<const Samples> samples_;
};

struct SplineFibres {
  NodeVectors directions;         ///< of each tet, a unit vector along dS/dw; zero where dS/dw is
  std::vector<double> distances;  ///< of its centroid from the solid, mm; about 0 inside
};

/// The fibre of each tet at the point of the solid next to its centroid. Cost: one nearest() for each tet;
/// parallel.
SplineFibres splineFibres(const TetMesh& mesh, const BsplineSolid& solid);

}  // namespace sinew
