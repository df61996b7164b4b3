#include "VolumeOffset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sinew {
namespace {

constexpr double kRadius = 10, kEdge = 1;

double ball(double radius) { return 4 * M_PI / 3 * radius * radius * radius; }
double area() { return 4 * M_PI * kRadius * kRadius; }

/// Trials with a ball in the mesh's place that lacks some of its radius.
std::vector<OffsetTrial> trialsOf(double lackingRadius, const VolumeRule& rule) {
  std::vector<OffsetTrial> trials;
  for (std::optional<double> offset = 0; offset;
       offset = nextOffset(trials, ball(kRadius), area(), kEdge, rule))
    trials.push_back({*offset, ball(kRadius - lackingRadius + *offset)});
  return trials;
}

double errorOf(const std::vector<OffsetTrial>& trials) {
  return trials[bestTrial(trials, ball(kRadius))].volume / ball(kRadius) - 1;
}

TEST(VolumeOffset, ExactMeansWithinATenthOfAPercent) {
  for (const double lacking : {0.09, 0.05, 0.01, -0.01, -0.09}) {
    const std::vector<OffsetTrial> trials = trialsOf(lacking, kExactVolume);
    EXPECT_LE(trials.size(), 3u) << lacking;
    EXPECT_LE(std::abs(errorOf(trials)), 0.001) << lacking;
    EXPECT_NEAR(trials.back().offset, lacking, 0.001 * kRadius / 3) << lacking;
  }
}

TEST(VolumeOffset, IsCappedAtATenthOfAnEdge) {
  EXPECT_DOUBLE_EQ(trialsOf(0.5, kExactVolume).back().offset, 0.1 * kEdge);
  EXPECT_DOUBLE_EQ(trialsOf(-0.5, kExactVolume).back().offset, -0.1 * kEdge);
  EXPECT_EQ(trialsOf(0.5, kExactVolume).size(), 2u) << "the same offset again";
}

TEST(VolumeOffset, ByDefaultOnlyWhatIsNoticedIsGivenBack) {
  EXPECT_EQ(trialsOf(0.016, kNoticeableVolume).size(), 1u) << "0.48 %";
  const std::vector<OffsetTrial> trials = trialsOf(0.04, kNoticeableVolume);
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_LT(std::abs(errorOf(trials)), 0.001);
  EXPECT_DOUBLE_EQ(trialsOf(0.5, kNoticeableVolume).back().offset, 0.05 * kEdge);
}

TEST(VolumeOffset, StopsAfterFourTrials) {
  std::vector<OffsetTrial> trials{{0, 100}, {0.01, 100}, {0.02, 100}};
  EXPECT_TRUE(nextOffset(trials, 200, 1e4, kEdge, kExactVolume).has_value());
  trials.push_back({0.03, 100});
  EXPECT_FALSE(nextOffset(trials, 200, 1e4, kEdge, kExactVolume).has_value());
}

TEST(VolumeOffset, AWorseMeshIsNotTaken) {
  const std::vector<OffsetTrial> trials{{0, 98}, {0.1, 103}, {0.05, 102}};
  EXPECT_EQ(bestTrial(trials, 100), 0u) << "the first of equals";
}

}  // namespace
}  // namespace sinew
