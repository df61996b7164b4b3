#include "TissueLevelSet.h"
#include "sinew/Segmentation/Phantom.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TissueLevelSet made(const Segmentation& segmentation, std::size_t tissue, const char* smoothing,
                    double edge = 2) {
  const Tissue& of = segmentation.tissues[tissue];
  return makeTissueLevelSet(segmentation, of,
                            planTissue(segmentation, of, {edge, false, parseSmoothing(smoothing)}, {}));
}

TEST(TissueLevelSet, SmoothingKeepsThinPartsWholeAndTheirVolume) {
  const Segmentation thin = makePhantom("thin");
  for (std::size_t t = 0; t < thin.tissues.size(); ++t)
    for (const char* smoothing : {"none", "light", "0.3mm2"}) {
      SCOPED_TRACE(thin.tissues[t].name + ", " + smoothing);
      const TissueLevelSet result = made(thin, t, smoothing);
      EXPECT_EQ(result.smoothing.levelSet, result.smoothing.voxels);
      EXPECT_EQ(result.smoothing.voxels.components, 1);
      EXPECT_EQ(smoothingWarning(result.smoothing), "");
    }
}

TEST(TissueLevelSet, StrongSmoothingSaysWhatItTook) {
  const Segmentation thin = makePhantom("thin");
  const TissueLevelSet result = made(thin, 0, "6mm2");
  EXPECT_EQ(result.smoothing.levelSet.components, 1) << "its topology is held";
  EXPECT_LT(result.smoothing.volumeChange, -0.1) << "a plate of a voxel wears away";
  const std::string warning = smoothingWarning(result.smoothing);
  EXPECT_TRUE(warning.starts_with("smoothing left ")) << warning;
  EXPECT_NE(warning.find(" % of the volume; try less of it"), std::string::npos) << warning;
}

TEST(TissueLevelSet, WhatACoarseLevelSetLosesIsNamed) {
  SmoothingReport report;
  report.voxels = {3, 1};
  report.levelSet = {1, 0};
  EXPECT_EQ(smoothingWarning(report),
            "smoothing left 1 pieces instead of 3, 0 cavities instead of 1; try less of it");
}

}  // namespace
}  // namespace sinew
