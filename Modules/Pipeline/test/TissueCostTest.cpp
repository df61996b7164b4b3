#include "TissueCost.h"
#include "sinew/Segmentation/Phantom.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TissueCost sphereCost(double edgeLength, double maxEdgeLength) {
  const Segmentation sphere = makePhantom("sphere");
  LevelSetFromLabelsOptions levelSet;
  levelSet.gridSpacing = 1;
  return estimateCost(sphere, sphere.tissues.front(), {edgeLength, maxEdgeLength}, levelSet);
}

TEST(TissueCost, GrowsWithTheSurfaceAndTheInside) {
  // Small edges: the voxels no longer count.
  EXPECT_NEAR(sphereCost(0.01, 1e3).memory / sphereCost(0.02, 1e3).memory, 4, 0.01);
  EXPECT_NEAR(sphereCost(0.01, 0.01).work / sphereCost(0.02, 0.02).work, 8, 0.1);
}

TEST(TissueCost, LargeEdgesStillPayForTheVoxels) {
  EXPECT_GT(sphereCost(1e3, 1e3).memory, 8 * 40. * 40 * 40) << "the box of the sphere, in voxels of 1 mm";
}

}  // namespace
}  // namespace sinew
