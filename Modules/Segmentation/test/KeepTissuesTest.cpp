#include "sinew/Segmentation/KeepTissues.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TEST(KeepTissues, OthersBecomeBackgroundOnTheirLayers) {
  Segmentation segmentation;
  segmentation.geometry.size = {4, 1, 1};
  segmentation.layers = {{0, 1, 2, 2}, {1, 1, 3, 0}};
  for (const auto& [layer, label, name] :
       {std::tuple(0, 1, "a"), std::tuple(0, 2, "b"), std::tuple(1, 1, "c"), std::tuple(1, 3, "d")}) {
    Tissue tissue;
    tissue.layer = layer;
    tissue.label = label;
    tissue.name = name;
    segmentation.tissues.push_back(tissue);
  }
  segmentation.emptyTissues.resize(1);
  keepTissues(segmentation, {1, 2});
  EXPECT_EQ(segmentation.layers, (std::vector<std::vector<std::int32_t>>{{0, 0, 2, 2}, {1, 1, 0, 0}}));
  ASSERT_EQ(segmentation.tissues.size(), 2u);
  EXPECT_EQ(segmentation.tissues[0].name, "b");
  EXPECT_EQ(segmentation.tissues[1].name, "c");
  EXPECT_TRUE(segmentation.emptyTissues.empty());
}

}  // namespace
}  // namespace sinew
