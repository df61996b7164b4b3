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

  /// @return how many impulses the last sweep still had to give
  /// Cost: O(sweeps * tets); tets that share no node at the same time, with the same bits for any number of
  /// threads.
  std::size_t apply(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                    NodeVectors& velocities) const;

 private:
  std::size_t limitTet(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                       std::size_t tet, NodeVectors& velocities) const;

  const ElasticBody& body_;
  StrainLimitOptions options_;
  std::vector<std::array<double, 4>> altitudes_;   ///< at rest, mm
  std::vector<std::vector<std::int32_t>> colors_;  ///< tets of one colour share no node
};

}  // namespace sinew
