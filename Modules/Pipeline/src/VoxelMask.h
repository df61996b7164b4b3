#pragma once

#include "sinew/Mesher/TetMesh.h"
#include "sinew/Segmentation/Segmentation.h"

#include <vector>

namespace sinew {

/// A set of voxels inside a box, one bit each.
class VoxelMask {
 public:
  VoxelMask() = default;
  explicit VoxelMask(const VoxelBox& box);

  const VoxelBox& box() const { return box_; }
  /// False outside of the box.
  bool test(const Eigen::Vector3i& index) const;
  std::int64_t count() const;
  /// Adds voxels first..last (inclusive, inside the box) of the row through (., y, z). Safe from several
  /// threads.
  void addRun(int first, int last, int y, int z);
  /// Adds or removes a voxel of the box. For one thread.
  void flip(const Eigen::Vector3i& index);

 private:
  std::size_t rowStart(int y, int z) const;

  VoxelBox box_;
  std::size_t wordsPerRow_ = 0;
  std::vector<std::uint64_t> words_;
};

/// The voxels whose centre lies in a tet of the mesh; centres on shared faces count once, and on the boundary
/// count.
/// @param toIndex  from the mesh's coordinates to continuous voxel indices
/// @param atLeast  a box that the mask's box shall hold
/// Cost: O(tets + voxel rows crossed by tets); the same for any number of threads.
VoxelMask voxelsInMesh(const TetMesh& mesh, const Eigen::Affine3d& toIndex, const VoxelBox& atLeast = {});

}  // namespace sinew
