#pragma once

#include <Eigen/Geometry>

namespace sinew {

/// The shape that the mesher fills: a signed distance, phi < 0 inside, |grad phi| = 1 near phi = 0.
/// All lengths in mm, in any right-handed orthonormal frame; the lattice follows its axes.
/// Implementations are safe to call from several threads at once.
class SignedDistance {
 public:
  virtual ~SignedDistance() = default;

  /// phi(x), mm. May be clamped to +-band() away from the surface.
  virtual double value(const Eigen::Vector3d& x) const = 0;
  /// phi(x), and its gradient into `gradient` (of the interpolant, not normalized; zero where clamped).
  virtual double valueAndGradient(const Eigen::Vector3d& x, Eigen::Vector3d& gradient) const = 0;
  /// A box outside of which phi > 0.
  virtual Eigen::AlignedBox3d bounds() const = 0;
  /// Spacing of the samples behind phi, mm: nothing smaller is represented.
  virtual double resolution() const = 0;
  /// |phi| is exact below this value, mm.
  virtual double band() const = 0;
};

}  // namespace sinew
