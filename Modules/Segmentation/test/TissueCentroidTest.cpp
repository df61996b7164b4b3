#include "sinew/Segmentation/TissueCentroid.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

/// Two voxels (1,1,0) and (2,1,0) of label 5, spacing 2 x 3 x 4, the first axis pointing along y.
Segmentation example() {
  Segmentation segmentation;
  segmentation.geometry.size = {4, 2, 1};
  segmentation.geometry.spacing = {2, 3, 4};
  segmentation.geometry.origin = {10, 20, 30};
  segmentation.geometry.direction << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  segmentation.layers = {{0, 9, 0, 0, 0, 5, 5, 0}};
  updateTissueTable(segmentation);
  return segmentation;
}

TEST(TissueCentroid, IsTheMeanOfTheVoxelCentresInSpace) {
  const Segmentation segmentation = example();
  ASSERT_EQ(segmentation.tissues[0].label, 5);
  EXPECT_TRUE(
      tissueCentroid(segmentation, segmentation.tissues[0]).isApprox(Eigen::Vector3d(10 + 3, 20 + 3, 30)));
}

TEST(TissueCentroid, BoundsReachToTheCornersOfTheVoxels) {
  const Segmentation segmentation = example();
  const auto [lower, upper] = tissueBounds(segmentation.geometry, segmentation.tissues[0]);
  EXPECT_TRUE(lower.isApprox(Eigen::Vector3d(10 + 1.5, 20 + 1, 30 - 2))) << lower;
  EXPECT_TRUE(upper.isApprox(Eigen::Vector3d(10 + 4.5, 20 + 5, 30 + 2))) << upper;
}

}  // namespace
}  // namespace sinew
