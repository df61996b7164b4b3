#pragma once

#include "sinew/LevelSet/SampleLattice.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace sinew {

/// Samples of a lattice, from the first to the last one, inclusive.
struct LatticeBox {
  Eigen::Vector3i lower, upper;
};

/// The smallest box of samples around a box of the lattice's own axes, mm, that is grown by `margin` mm.
/// @throws std::invalid_argument that begins with `operation` when there are more than `mostSamples`.
inline LatticeBox latticeBox(const Eigen::AlignedBox3d& box, double spacing, double margin,
                             const std::string& operation, std::int64_t mostSamples = std::int64_t{1} << 31) {
  const Eigen::Array3d lower = ((box.min().array() - margin) / spacing).floor();
  const Eigen::Array3d upper = ((box.max().array() + margin) / spacing).ceil();
  const double samples = (upper - lower + 1).prod();
  constexpr double kFarthest = 1e9;  // an index is an int
  if (!(samples <= static_cast<double>(mostSamples)) || !(lower.abs().max(upper.abs()) < kFarthest).all())
    throw std::invalid_argument(operation + ": a spacing of " + std::to_string(spacing) +
                                " mm is too fine for a box of " + std::to_string(box.sizes().maxCoeff()) +
                                " mm; at most " + std::to_string(mostSamples) + " samples are allowed");
  return {lower.cast<int>(), upper.cast<int>()};
}

}  // namespace sinew
