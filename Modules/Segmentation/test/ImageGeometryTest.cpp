#include "sinew/Segmentation/ImageGeometry.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

ImageGeometry obliqueGeometry() {
  ImageGeometry geometry;
  geometry.size = {4, 5, 6};
  geometry.spacing = {0.5, 2, 3};
  geometry.origin = {-10, 20, 30};
  // Turned about z by the 3-4-5 triangle, the last axis reflected.
  geometry.direction << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, -1;
  return geometry;
}

TEST(ImageGeometry, IndexGoesAlongTheScaledAxesFromTheOrigin) {
  const Eigen::Vector3d x = obliqueGeometry().indexToPhysical() * Eigen::Vector3d(2, 1, 3);
  // origin + 2 * 0.5 * (0.6, 0.8, 0) + 1 * 2 * (-0.8, 0.6, 0) + 3 * 3 * (0, 0, -1); a few roundings of 1e-15
  EXPECT_LT((x - Eigen::Vector3d(-11, 22, 21)).norm(), 1e-13);
}

TEST(ImageGeometry, VoxelVolumeIsThatOfTheEdgesAlsoWhenReflected) {
  EXPECT_NEAR(obliqueGeometry().voxelVolume(), 3, 1e-14);
  EXPECT_NEAR(obliqueGeometry().meanSpacing(), std::cbrt(3.0), 1e-14);
}

TEST(ImageGeometry, ShearLessensTheVoxelVolume) {
  ImageGeometry geometry;
  geometry.spacing = {1, 1, 2};
  geometry.direction.col(2) = Eigen::Vector3d(0, 0.6, 0.8);
  EXPECT_NEAR(geometry.voxelVolume(), 2 * 0.8, 1e-15);
}

TEST(ImageGeometry, VoxelCountDoesNotOverflow32Bits) {
  ImageGeometry geometry;
  geometry.size = {2048, 2048, 2048};
  EXPECT_EQ(geometry.voxelCount(), std::int64_t{1} << 33);
}

}  // namespace
}  // namespace sinew
