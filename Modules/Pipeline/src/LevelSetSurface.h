#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/LevelSet/LevelSetMeasures.h"
#include "sinew/Mesher/SignedDistance.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew {

/// The door from a level set to the Mesher: its trilinear interpolant, +band beyond the raster, and the exact
/// gradient, in the level set's own frame: x = voxelSize * index, mm. `DenseLevelSet::frame` leads from there
/// to LPS.
///
/// The values are copied into bricks of 8^3 cells with the nodes on all their faces (9^3 values), one table
/// entry per brick of the box, so that any sample costs one table entry and eight values of one brick; bricks
/// outside of the narrow band share two constant ones. The level set is not needed afterwards.
class LevelSetSurface final : public SignedDistance {
 public:
  /// Cost: O(samples), bricks in parallel; memory 2.9 kB per brick of the band.
  explicit LevelSetSurface(const DenseLevelSet& levelSet);

  double value(const Eigen::Vector3d& x) const override;
  double valueAndGradient(const Eigen::Vector3d& x, Eigen::Vector3d& gradient) const override;
  Eigen::AlignedBox3d bounds() const override { return bounds_; }
  double resolution() const override { return voxelSize_; }
  double band() const override { return band_; }

  static constexpr int kLog2Cells = 3;
  static constexpr int kCells = 1 << kLog2Cells;  ///< cells of a brick along an axis

  /// Indices of the bricks' nodes lie in [nodesLower, nodesUpper); beyond, phi = band.
  const Eigen::Vector3i& nodesLower() const { return origin_; }
  Eigen::Vector3i nodesUpper() const { return origin_ + kCells * count_; }
  /// First node of every brick in the band; the surface lies in them.
  std::vector<Eigen::Vector3i> bandBricks() const;
  /// phi at the grid's node voxelSize * index, without rounding, mm.
  float atNode(const Eigen::Vector3i& index) const;

 private:
  friend class LevelSetTopologyCounter;

  static constexpr int kNodes = kCells + 1;
  static constexpr int kStrideX = kNodes * kNodes;
  static constexpr int kStrideY = kNodes;
  static constexpr std::size_t kBrickSize = kNodes * kNodes * kNodes;
  static constexpr std::uint32_t kInside = 0;   ///< brick of -band
  static constexpr std::uint32_t kOutside = 1;  ///< brick of +band

  struct Cell {
    const float* lower;        ///< value at the lowest corner; nullptr outside of the box
    Eigen::Vector3d fraction;  ///< position in the cell, [0, 1)
  };
  Cell cellAt(const Eigen::Vector3d& x) const;
  const float* brick(const Eigen::Vector3i& position) const;
  std::size_t entry(const Eigen::Vector3i& position) const;

  double voxelSize_;
  double inverseVoxelSize_;
  double band_;
  Eigen::AlignedBox3d bounds_;
  Eigen::Vector3i origin_;            ///< index of the first brick's first node, one before the raster's
  Eigen::Vector3i count_;             ///< bricks along each axis
  Eigen::Vector3d extent_;            ///< cells along each axis
  std::vector<std::uint32_t> table_;  ///< brick of each place, z fastest
  std::vector<float> values_;         ///< bricks, z fastest
};

/// Shape of phi < 0 as a space, from the signs at the grid nodes on Kuhn's subdivision of the grid into tets
/// (which has no ambiguous cases).
/// Cost: O(voxels of the band).
LevelSetTopology levelSetTopology(const LevelSetSurface& surface);

}  // namespace sinew
