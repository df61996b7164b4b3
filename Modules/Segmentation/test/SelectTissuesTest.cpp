#include "sinew/Segmentation/SelectTissues.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

Tissue tissue(const std::string& name, std::int32_t label, int layer = 0) {
  Tissue tissue;
  tissue.name = name;
  tissue.id = "Segment_" + std::to_string(label);
  tissue.label = label;
  tissue.layer = layer;
  return tissue;
}

Segmentation arm() {
  Segmentation arm;
  arm.source = "arm.nrrd";
  arm.tissues = {tissue("humerus", 1), tissue("biceps", 2), tissue("triceps long head", 3), tissue("7", 4),
                 tissue("biceps", 7, 1)};
  arm.emptyTissues = {tissue("skin", 9)};
  return arm;
}

using Indices = std::vector<int>;

TEST(SelectTissues, NoWishMeansAll) { EXPECT_EQ(selectTissues(arm(), {}), (Indices{0, 1, 2, 3, 4})); }

TEST(SelectTissues, ByNameIdLabelAndLooseName) {
  EXPECT_EQ(selectTissues(arm(), {"humerus"}), (Indices{0}));
  EXPECT_EQ(selectTissues(arm(), {"Segment_3"}), (Indices{2}));
  EXPECT_EQ(selectTissues(arm(), {"3"}), (Indices{2}));
  EXPECT_EQ(selectTissues(arm(), {"Triceps_Long-Head"}), (Indices{2}));
  EXPECT_EQ(selectTissues(arm(), {"biceps"}), (Indices{1, 4})) << "on both layers";
  EXPECT_EQ(selectTissues(arm(), {"7"}), (Indices{3})) << "a name goes before a label";
}

TEST(SelectTissues, RepeatedWishesCountOnceInTheOrderOfTheTable) {
  EXPECT_EQ(selectTissues(arm(), {"3", "humerus", "1"}), (Indices{0, 2}));
}

TEST(SelectTissues, AnUnknownNameListsTheNearest) {
  const auto message = [](const std::string& wish) {
    return test::messageOf<std::invalid_argument>([&] { selectTissues(arm(), {wish}); });
  };
  EXPECT_NE(message("bicep").find("arm.nrrd: no tissue 'bicep'; the nearest names are 'biceps', "),
            std::string::npos);
  EXPECT_NE(message("long head").find("are 'triceps long head', "), std::string::npos);
  EXPECT_NE(message("humreus").find("are 'humerus', "), std::string::npos);
  EXPECT_EQ(message("skin"), "arm.nrrd: tissue 'skin' has no voxel");
}

}  // namespace
}  // namespace sinew
