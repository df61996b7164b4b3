#include "sinew/Segmentation/Segmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sinew {
namespace {

Segmentation segmentationOf(const Eigen::Vector3i& size, std::vector<std::vector<std::int32_t>> layers) {
  Segmentation segmentation;
  segmentation.geometry.size = size;
  segmentation.layers = std::move(layers);
  return segmentation;
}

Tissue entry(const std::string& name, int layer, std::int32_t label) {
  Tissue tissue;
  tissue.name = tissue.id = name;
  tissue.layer = layer;
  tissue.label = label;
  tissue.named = true;
  return tissue;
}

TEST(Segmentation, AtIsXFastest) {
  const auto s = segmentationOf({2, 3, 2}, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}});
  EXPECT_EQ(s.at(0, {1, 0, 0}), 1);
  EXPECT_EQ(s.at(0, {0, 2, 0}), 4);
  EXPECT_EQ(s.at(0, {1, 2, 1}), 11);
}

TEST(UpdateTissueTable, CountsVoxelsAndBoxes) {
  auto s = segmentationOf({4, 3, 2}, {{0, 0, 5, 5, 0, 5, 5, 0, 0,     0, 0, -3,  //
                                       0, 0, 0, 0, 0, 0, 0, 0, 70000, 0, 0, 0}});
  updateTissueTable(s);
  ASSERT_EQ(s.tissues.size(), 3u);
  EXPECT_EQ(s.tissues[0].label, -3);
  EXPECT_EQ(s.tissues[0].voxels, 1);
  EXPECT_EQ(s.tissues[0].box.lower, Eigen::Vector3i(3, 2, 0));
  EXPECT_EQ(s.tissues[0].box.upper, Eigen::Vector3i(4, 3, 1));
  EXPECT_EQ(s.tissues[1].label, 5);
  EXPECT_EQ(s.tissues[1].name, "Segment_5");
  EXPECT_FALSE(s.tissues[1].named);
  EXPECT_EQ(s.tissues[1].voxels, 4);
  EXPECT_EQ(s.tissues[1].box.lower, Eigen::Vector3i(1, 0, 0));
  EXPECT_EQ(s.tissues[1].box.upper, Eigen::Vector3i(4, 2, 1));
  EXPECT_EQ(s.tissues[2].label, 70000);
  EXPECT_EQ(s.tissues[2].box.lower, Eigen::Vector3i(0, 2, 1));
}

TEST(UpdateTissueTable, AgreesWithCountingVoxelByVoxelInNoise) {
  constexpr unsigned seed = 7;
  std::mt19937 random(seed);
  const Eigen::Vector3i size(17, 13, 11);
  std::vector<std::int32_t> labels(static_cast<std::size_t>(size.prod()));
  const std::int32_t values[]{0, 1, 2, 65535, 65536, -1, INT32_MAX, INT32_MIN};
  for (auto& label : labels) label = values[random() % std::size(values)];
  auto s = segmentationOf(size, {labels});
  updateTissueTable(s);
  ASSERT_EQ(s.tissues.size(), std::size(values) - 1) << "seed " << seed;
  for (const Tissue& tissue : s.tissues) {
    EXPECT_EQ(tissue.voxels, std::ranges::count(labels, tissue.label));
    Eigen::Vector3i lower = size, upper = Eigen::Vector3i::Zero();
    for (int k = 0; k < size.z(); ++k)
      for (int j = 0; j < size.y(); ++j)
        for (int i = 0; i < size.x(); ++i)
          if (const Eigen::Vector3i at(i, j, k); s.at(0, at) == tissue.label) {
            lower = lower.cwiseMin(at);
            upper = upper.cwiseMax(at + Eigen::Vector3i::Ones());
          }
    EXPECT_EQ(tissue.box.lower, lower);
    EXPECT_EQ(tissue.box.upper, upper);
  }
}

TEST(UpdateTissueTable, SameLabelOnTwoLayersIsTwoTissues) {
  auto s = segmentationOf({3, 1, 1}, {{1, 1, 0}, {0, 1, 1}});
  s.tissues = {entry("upper", 1, 1), entry("lower", 0, 1)};
  updateTissueTable(s);
  ASSERT_EQ(s.tissues.size(), 2u);
  EXPECT_EQ(s.tissues[0].name, "lower");
  EXPECT_EQ(s.tissues[0].box.lower.x(), 0);
  EXPECT_EQ(s.tissues[1].name, "upper");
  EXPECT_EQ(s.tissues[1].box.lower.x(), 1);
}

TEST(UpdateTissueTable, UnnamedTissuesOfTwoLayersHaveDifferentNames) {
  auto s = segmentationOf({2, 1, 1}, {{4, 0}, {0, 4}});
  updateTissueTable(s);
  EXPECT_EQ(s.tissues[0].name, "Segment_4");
  EXPECT_EQ(s.tissues[1].name, "Segment_4_layer_1");
}

TEST(UpdateTissueTable, EntriesWithoutVoxelsMoveAndComeBack) {
  auto s = segmentationOf({2, 1, 1}, {{1, 0}});
  s.tissues = {entry("one", 0, 1), entry("two", 0, 2), entry("elsewhere", 5, 1)};
  updateTissueTable(s);
  ASSERT_EQ(s.tissues.size(), 1u);
  ASSERT_EQ(s.emptyTissues.size(), 2u);
  EXPECT_EQ(s.emptyTissues[0].name, "two");
  EXPECT_TRUE(s.emptyTissues[0].box.empty());

  s.layers[0][1] = 2;
  updateTissueTable(s);
  ASSERT_EQ(s.tissues.size(), 2u);
  EXPECT_EQ(s.tissues[1].name, "two");
  EXPECT_EQ(s.tissues[1].voxels, 1);
}

TEST(UpdateTissueTable, ColoursOfUnnamedLabelsAreBrightAndFarApart) {
  std::vector<std::int32_t> labels(20);
  for (int i = 0; i < 20; ++i) labels[i] = i;
  auto s = segmentationOf({20, 1, 1}, {labels});
  updateTissueTable(s);
  for (const Tissue& tissue : s.tissues) {
    for (const double channel : tissue.color) {
      EXPECT_GE(channel, 0);
      EXPECT_LE(channel, 1);
    }
    EXPECT_NEAR(*std::ranges::max_element(tissue.color), 0.9, 1e-12) << tissue.name;  // the value of HSV
    const auto same = [&](const Tissue& other) { return other.color == tissue.color; };
    EXPECT_EQ(std::ranges::count_if(s.tissues, same), 1) << tissue.name;
  }
}

}  // namespace
}  // namespace sinew
