#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace sinew {

/// Where the voxels of an image lie, in ITK's physical space (LPS, mm).
///
///     x(i) = origin + direction * diag(spacing) * i        i: continuous voxel index, voxel centres at integers
struct ImageGeometry {
  Eigen::Vector3i size = Eigen::Vector3i::Zero();               ///< voxels along each index axis
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();            ///< mm, > 0
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();             ///< centre of voxel (0,0,0), mm
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();      ///< columns: unit vectors of the index axes

  /// Continuous voxel index to physical LPS mm. May reflect and, for tilted gantries, shear.
  Eigen::Affine3d indexToPhysical() const;
  /// |det| of one voxel's edges, mm^3.
  double voxelVolume() const;
  /// Cube root of the voxel volume, mm: what the suffix `vox` stands for.
  double meanSpacing() const;
  std::int64_t voxelCount() const;
};

}  // namespace sinew
