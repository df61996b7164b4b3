#include "sinew/Simulation/MeshTrial.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

TEST(MeshTrial, RefusesAMeshThatNothingHolds) {
  EXPECT_THROW(runTrial(test::barMesh({1, 1, 2}, 1), {}), std::invalid_argument);
}

TEST(MeshTrial, StartsAtRest) {
  const TetMesh mesh = test::barMesh({1, 1, 2}, 1);
  int frames = 0;
  const TrialReport report = runTrial(mesh, {.attachments = {{0, 1, 2, 3}, {8, 9, 10, 11}}}, {},
                                      [&](const TrialFrame& frame, const NodeVectors& places) {
                                        if (frames++ > 0) return;
                                        EXPECT_EQ(frame.time, 0);
                                        EXPECT_EQ(places, mesh.nodes);
                                        EXPECT_NEAR(frame.volume, 2, 1e-12);  // round-off
                                      });
  ASSERT_FALSE(report.frames.empty());
  EXPECT_EQ(report.frames.size(), static_cast<std::size_t>(frames));
}

}  // namespace
}  // namespace sinew
