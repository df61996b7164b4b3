#pragma once

#include "NodeStarEnergy.h"

#include <span>
#include <vector>

namespace sinew {

/// The tets around one node for the goal measure m: of all of them at a place of the node, their other nodes
/// held. One row per coordinate, so that the loops over the tets become vector instructions; the same bits as
/// goalMeasure() where that is compiled without fused multiply-adds.
class GoalStar {
 public:
  void gather(std::span<const StarFaceNodes> faces, const std::vector<Eigen::Vector3d>& nodes);

  std::size_t size() const { return tets_; }
  /// m of the first `count` tets with the node at x; valid until the next call.
  std::span<const double> measures(const Eigen::Vector3d& x, std::size_t count);
  /// Sum of m^power over the first `count` tets. @param power  a power of two
  double energy(const Eigen::Vector3d& x, int power, std::size_t count);
  /// From x to the nearest of the other nodes.
  double shortestEdge(const Eigen::Vector3d& x) const;
  void swap(std::size_t s, std::size_t t);

 private:
  static constexpr std::size_t kCorners = 9;  // rows: x, y, z of the other three nodes; one more for m
  std::size_t tets_ = 0, capacity_ = 0;
  std::vector<double> rows_;
};

}  // namespace sinew
