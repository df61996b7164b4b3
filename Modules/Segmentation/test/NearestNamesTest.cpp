#include "sinew/Segmentation/NearestNames.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

const std::vector<std::string> kNames{"humerus", "Biceps_brachii", "biceps", "skin", "skin"};

TEST(NearestNames, FewerChangesComeFirst) {
  EXPECT_EQ(nearestNames("humreus", kNames, 1), "'humerus'");
  EXPECT_EQ(nearestNames("skim", kNames, 1), "'skin'");
}

TEST(NearestNames, NamesThatContainWhatWasTypedComeBeforeTheRest) {
  EXPECT_EQ(nearestNames("bicep", kNames, 2), "'biceps', 'Biceps_brachii'");
  EXPECT_EQ(nearestNames("brachii", kNames, 1), "'Biceps_brachii'");
}

TEST(NearestNames, EachNameComesOnce) {
  EXPECT_EQ(nearestNames("skin", kNames, 9), "'skin', 'biceps', 'humerus', 'Biceps_brachii'");
  EXPECT_EQ(nearestNames("skin", {}), "");
}

TEST(NearestNames, LooseNamesForgetCaseAndJoints) { EXPECT_EQ(looseName("Long-Head_2"), "long head 2"); }

}  // namespace
}  // namespace sinew
