#pragma once

#include "sinew/Elasticity/NodeConstraints.h"

namespace sinew {

struct StrainLimitOptions {
  double strain = 0.5;  ///< an altitude stays within (1 - strain, 1 + strain) of its length at rest
  double change = 0.1;  ///< and changes by at most this share of it in a step
  int sweeps = 4;       ///< over all tets
};

/// Keeps tets from being flattened in a step: where an altitude would leave its bounds, an impulse along it,
/// equal and opposite on the node and the foot, which changes neither linear nor angular momentum. One
/// altitude after the other (Gauss-Seidel), so an earlier one may be pushed out again a little; held nodes
/// count as infinitely heavy.
/// Source: Bridson et al. 2003, section 4.2; Teran et al. 2005, section 7.3.
class StrainLimits {
 public:
  /// Keeps a reference to the body. @throws std::invalid_argument on options out of range
  explicit StrainLimits(const ElasticBody& body, const StrainLimitOptions& options = {});

  /// @return how many impulses the last sweep gave where bounds are still broken after it
  /// Cost: O(tets) in parallel to find the tets that break a bound; these are then changed one after the
  /// other, and from the second sweep on only they and their neighbours are looked at.
  std::size_t apply(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                    NodeVectors& velocities) const;

 private:
  /// What the height needs to stay in its bounds after the step, mm; 0 when it does.
  double excess(double atRest, double now, double next) const;
  /// Of the tets tetAt(k), k < count, those that break a bound.
  template <class TetAt>
  std::vector<std::int32_t> broken(std::size_t count, const TetAt& tetAt, const NodeVectors& places,
                                   const NodeVectors& velocities, double dt) const;
  void addTetsAround(std::int32_t tet, std::vector<std::uint8_t>& listed,
                     std::vector<std::int32_t>& list) const;
  std::size_t limitTet(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                       std::size_t tet, NodeVectors& velocities) const;

  const ElasticBody& body_;
  StrainLimitOptions options_;
  std::vector<std::array<double, 4>> altitudes_;  ///< at rest, mm
};

}  // namespace sinew
