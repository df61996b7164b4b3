#include "TissuePlan.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

/// A plate of 40 x 30 x 3 voxels of 1 mm.
Segmentation plate() {
  Segmentation segmentation;
  segmentation.geometry.size = {44, 34, 7};
  segmentation.layers.emplace_back();
  for (int z = 0; z < 7; ++z)
    for (int y = 0; y < 34; ++y)
      for (int x = 0; x < 44; ++x)
        segmentation.layers[0].push_back(x > 1 && x < 42 && y > 1 && y < 32 && z > 1 && z < 5);
  updateTissueTable(segmentation);
  return segmentation;
}

TissuePlan planOf(double edge, const MeshTissuesOptions& options = {}) {
  const Segmentation segmentation = plate();
  return planTissue(segmentation, segmentation.tissues[0], {.edge = edge}, options);
}

TEST(TissuePlan, TakesTheSizesThatFit) {
  const TissuePlan plan = planOf(2);
  EXPECT_EQ(plan.sizes.edge, 2);
  EXPECT_EQ(plan.sizes.largest, 16);
  EXPECT_FALSE(plan.sizeReduced);
  MeshTissuesOptions options;
  options.maxEdgeLength = 5;
  EXPECT_EQ(planOf(2, options).sizes.largest, 5);
  EXPECT_EQ(planOf(6, options).sizes.largest, 6) << "never below the edge length";
}

TEST(TissuePlan, NoCubeIsLargerThanTheTissue) {
  const TissuePlan plan = planOf(50);
  EXPECT_EQ(plan.sizes.edge, 40);
  EXPECT_EQ(plan.sizes.largest, 40);
  EXPECT_TRUE(plan.sizeReduced);
}

TEST(TissuePlan, RefinementStopsAtTheSmallestCube) {
  EXPECT_EQ(planOf(2).sizes.smallest, planOf(2).levelSet.gridSpacing);
  EXPECT_EQ(planOf(2).thinnest, 0.5) << "half a voxel";
  EXPECT_EQ(planOf(3).thinnest, 0.75) << "a quarter of the edge length";
  MeshTissuesOptions options;
  options.minEdgeLength = 1.5;
  EXPECT_EQ(planOf(2, options).sizes.smallest, 1.5);
  EXPECT_EQ(planOf(2, options).thinnest, 1.5);
  EXPECT_LT(planOf(50, options).sizes.smallest, 40);
  const Segmentation segmentation = plate();
  EXPECT_EQ(planTrial(segmentation, segmentation.tissues[0], {.edge = 12}, options).sizes.smallest, 3);
  EXPECT_EQ(planTrial(segmentation, segmentation.tissues[0], {.edge = 2}, options).sizes.smallest, 1.5);
  EXPECT_EQ(planTrial(segmentation, segmentation.tissues[0], {.edge = 2}, {}).sizes.smallest, 1);
}

TEST(TissuePlan, ASpeckMayBeRefinedOnce) {
  Segmentation segmentation = plate();
  std::vector<std::int32_t>& voxels = segmentation.layers[0];
  std::fill(voxels.begin(), voxels.end(), 0);
  voxels[44 * 34 * 3 + 44 * 10 + 10] = 1;
  updateTissueTable(segmentation);
  MeshTissuesOptions options;
  options.minEdgeLength = Length::voxels(0.5);
  const TissuePlan plan = planTissue(segmentation, segmentation.tissues[0], {.edge = 2}, options);
  EXPECT_TRUE(plan.sizeReduced);
  EXPECT_DOUBLE_EQ(plan.sizes.edge, 1. / 3);
  EXPECT_DOUBLE_EQ(plan.sizes.smallest, 1. / 6);
  const TissuePlan usual = planTissue(segmentation, segmentation.tissues[0], {.edge = 2}, {});
  EXPECT_DOUBLE_EQ(usual.sizes.smallest, usual.levelSet.gridSpacing);
}

TEST(TissuePlan, TheBandReachesWhereTheMesherLooks) {
  for (const bool preserve : {false, true}) {
    MeshTissuesOptions options;
    options.preserveVolume = preserve;
    const double offset = preserve ? 0.1 : 0.05;  // edge lengths that the surface may be moved by
    for (const double edge : {0.5, 2., 9.}) {
      const TissuePlan plan = planOf(edge, options);
      EXPECT_GE(plan.levelSet.bandVoxels * plan.levelSet.gridSpacing, (1.55 + offset - 1e-12) * edge);
      EXPECT_GE(plan.levelSet.gridSpacing, edge / 5 - 1e-12);
    }
  }
}

}  // namespace
}  // namespace sinew
