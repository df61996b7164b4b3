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

TEST(TissueLevelSet, WhatStrongSmoothingTakesIsNamed) {
  SmoothingReport report;
  report.volumeChange = -0.25;
  EXPECT_EQ(smoothingWarning(report), "smoothing left 75 % of the volume; try less of it");
  report.volumeChange = 0.001;
  EXPECT_EQ(smoothingWarning(report), "") << "as near as smooth keeps it";
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
