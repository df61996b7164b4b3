#include "sinew/LevelSet/VoxelsInside.h"

#include "sinew/LevelSet/FieldResampling.h"
#include "sinew/LevelSet/ShapeMeasures.h"

namespace sinew {
namespace {

/// The voxels of the image whose centres lie in the box of the level set's samples.
VoxelBox voxelsOf(const DenseLevelSet& levelSet, const ImageGeometry& geometry) {
  const Eigen::Affine3d toVoxel =
      geometry.indexToPhysical().inverse() * levelSet.frame * Eigen::Scaling(levelSet.voxelSize);
  const Eigen::Vector3d last = (levelSet.phi.size - Eigen::Vector3i::Ones()).cast<double>();
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner)
    box.extend(toVoxel * last.cwiseProduct(Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2)));
  // Far outside of the image an index would leave the range of int.
  const Eigen::Vector3d size = geometry.size.cast<double>();
  VoxelBox voxels;
  voxels.lower = box.min().cwiseMax(0).cwiseMin(size).array().ceil().cast<int>();
  voxels.upper = (box.max() + Eigen::Vector3d::Ones()).cwiseMax(0).cwiseMin(size).array().floor().cast<int>();
  return voxels;
}

}  // namespace

PhiAtVoxels phiAtVoxels(const DenseLevelSet& levelSet, const ImageGeometry& geometry) {
  PhiAtVoxels result{voxelsOf(levelSet, geometry), {}};
  if (result.box.empty()) return result;
  const Eigen::Affine3d toSamples = Eigen::Scaling(1 / levelSet.voxelSize) * levelSet.frame.inverse() *
                                    geometry.indexToPhysical() *
                                    Eigen::Translation3d(result.box.lower.cast<double>());
  result.phi = resampleAffine(levelSet.phi, toSamples, result.box.upper - result.box.lower);
  return result;
}

}  // namespace sinew
