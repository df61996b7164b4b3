#include "AssembleLabels.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sinew::repair {
namespace {

/// A row of voxels, one digit each; layers of the same length.
Segmentation row(const std::vector<std::string>& layers,
                 const std::vector<std::string>& names = {"a", "b", "c"}) {
  Segmentation segmentation;
  segmentation.geometry.size = {static_cast<int>(layers[0].size()), 1, 1};
  segmentation.keys["Segmentation_Source"] = "test";
  for (const std::string& layer : layers) {
    std::vector<std::int32_t> labels;
    for (const char c : layer) labels.push_back(c - '0');
    segmentation.layers.push_back(labels);
  }
  for (std::size_t n = 0; n < names.size(); ++n)
    for (int layer = 0; layer < static_cast<int>(layers.size()); ++layer) {
      const auto label = static_cast<std::int32_t>(n + 1);
      if (layer > 0 &&
          std::ranges::find(segmentation.layers[layer], label) == segmentation.layers[layer].end())
        continue;
      Tissue tissue;
      tissue.name = names[n] + (layer > 0 ? "'" : "");
      tissue.id = "id-" + tissue.name;
      tissue.label = label;
      tissue.layer = layer;
      tissue.color = {0.1, 0.2, 0.3};
      tissue.tags["Finding"] = tissue.name;
      segmentation.tissues.push_back(tissue);
    }
  updateTissueTable(segmentation);
  return segmentation;
}

std::string text(const std::vector<std::int32_t>& labels) {
  std::string text;
  for (const std::int32_t label : labels) text += static_cast<char>('0' + label);
  return text;
}

std::vector<std::string> texts(const Segmentation& segmentation) {
  std::vector<std::string> layers;
  for (const auto& layer : segmentation.layers) layers.push_back(text(layer));
  return layers;
}

/// Voxels where the mask has an x, from `first` on.
Claim claim(const std::string& name, int tissue, const std::string& mask, int first = 0) {
  Claim claim{name, tissue, {}, {}};
  const int size = static_cast<int>(mask.size());
  claim.voxels.box = {{first, 0, 0}, {first + size, 1, 1}};
  claim.voxels.inside = DenseMask({size, 1, 1});
  for (int i = 0; i < size; ++i) claim.voxels.inside.values[i] = mask[i] == 'x';
  return claim;
}

using Texts = std::vector<std::string>;
using Yielded = std::vector<std::pair<std::string, std::int64_t>>;

TEST(AssembleLabels, WithoutWishesNothingChanges) {
  const Segmentation input = row({"0112203", "0300000"});
  const Segmentation output = assembleLabels(input, {}).segmentation;
  EXPECT_EQ(output.layers, input.layers);
  EXPECT_EQ(output.keys, input.keys);
  ASSERT_EQ(output.tissues.size(), input.tissues.size());
  for (std::size_t t = 0; t < input.tissues.size(); ++t) {
    EXPECT_EQ(output.tissues[t].name, input.tissues[t].name);
    EXPECT_EQ(output.tissues[t].id, input.tissues[t].id);
    EXPECT_EQ(output.tissues[t].tags, input.tissues[t].tags);
    EXPECT_EQ(output.tissues[t].color, input.tissues[t].color);
    EXPECT_EQ(output.tissues[t].voxels, input.tissues[t].voxels);
  }
}

TEST(AssembleLabels, AClaimReplacesAndYieldsToOthers) {
  const AssembledLabels result = assembleLabels(row({"0112203"}), {.claims = {claim("a", 0, "xx0xxxx")}});
  EXPECT_EQ(texts(result.segmentation), Texts{"1102213"});
  EXPECT_EQ(result.claims[0].voxelsBefore, 2);
  EXPECT_EQ(result.claims[0].voxelsAfter, 3);
  EXPECT_EQ(result.claims[0].yielded, (Yielded{{"b", 2}, {"c", 1}}));
  EXPECT_TRUE(result.losses.empty());
}

TEST(AssembleLabels, TheLaterClaimWins) {
  const AssembledLabels result =
      assembleLabels(row({"0112203"}), {.claims = {claim("a", 0, "xxxx"), claim("b", 1, "xxxx", 2)}});
  EXPECT_EQ(texts(result.segmentation), Texts{"1122223"});
  EXPECT_EQ(result.claims[0].yielded, (Yielded{{"b", 2}}));
  EXPECT_EQ(result.claims[1].yielded, Yielded{});
  EXPECT_EQ(
      texts(assembleLabels(row({"0112203"}), {.claims = {claim("b", 1, "xxxx", 2), claim("a", 0, "xxxx")}})
                .segmentation),
      Texts{"1111223"});
}

TEST(AssembleLabels, PriorityWinsOverEverything) {
  const AssembledLabels result = assembleLabels(
      row({"0112203"}),
      {.claims = {claim("a", 0, "xxxxxxx"), claim("new", -1, "xxx", 4)}, .priority = {"c", "a"}});
  EXPECT_EQ(texts(result.segmentation), Texts{"1111113"}) << "c before a, a before all others";
  EXPECT_EQ(result.claims[0].yielded, (Yielded{{"c", 1}}));
  EXPECT_EQ(result.claims[1].yielded, (Yielded{{"a", 2}, {"c", 1}}));
  ASSERT_EQ(result.losses.size(), 1u);
  EXPECT_EQ(result.losses[0].loser, "b");
  EXPECT_EQ(result.losses[0].winner, "a");
  EXPECT_EQ(result.losses[0].voxels, 2);
}

TEST(AssembleLabels, RemovedTissuesLeaveNothing) {
  const AssembledLabels result = assembleLabels(row({"0112203"}), {.removed = {1}});
  EXPECT_EQ(texts(result.segmentation), Texts{"0110003"});
  EXPECT_EQ(result.segmentation.tissues.size(), 2u);
  EXPECT_TRUE(result.segmentation.emptyTissues.empty());
}

TEST(AssembleLabels, NewTissuesGetAFreeLabelAndAColour) {
  Claim red = claim("red", -1, "x");
  red.color = {1, 0, 0};
  const AssembledLabels result =
      assembleLabels(row({"0013"}, {"a", "", "c"}), {.claims = {red, claim("other", -1, "x", 1)}});
  EXPECT_EQ(texts(result.segmentation), Texts{"4513"}) << "2 is the label of a tissue without voxels";
  const auto found = [&](const std::string& name) {
    return *std::ranges::find(result.segmentation.tissues, name, &Tissue::name);
  };
  EXPECT_EQ(found("red").color, (std::array{1., 0., 0.}));
  EXPECT_EQ(found("other").color, labelColor(5));
  EXPECT_TRUE(found("other").named);
}

TEST(AssembleLabels, ANewTissueTakesTheEmptyEntryOfItsName) {
  const AssembledLabels result = assembleLabels(row({"0101"}), {.claims = {claim("b", -1, "x")}});
  EXPECT_EQ(texts(result.segmentation), Texts{"2101"});
  ASSERT_EQ(result.segmentation.tissues.size(), 2u);
  EXPECT_EQ(result.segmentation.tissues[1].tags.at("Finding"), "b");
  EXPECT_EQ(result.segmentation.emptyTissues.size(), 1u) << "c";
}

TEST(AssembleLabels, LayersKeepOverlaps) {
  const AssembledLabels result = assembleLabels(
      row({"0112203"}),
      {.claims = {claim("a", 0, "xxxx"), claim("new", -1, "xx", 3), claim("more", -1, "x")}, .layers = true});
  EXPECT_EQ(texts(result.segmentation), (Texts{"5002203", "1111000", "0004400"}));
  EXPECT_EQ(result.claims[0].layer, 1);
  EXPECT_EQ(result.claims[0].label, 1);
  EXPECT_EQ(result.claims[0].voxelsAfter, 4);
  EXPECT_EQ(result.claims[1].layer, 2);
  EXPECT_EQ(result.claims[2].layer, 0) << "there it is free";
}

TEST(AssembleLabels, ALabelThatIsTakenOnAnotherLayerIsNotUsedTwice) {
  // a of layer 0 overlaps b, and layer 1 has a label 1 of its own.
  const AssembledLabels result =
      assembleLabels(row({"01122", "10000"}), {.claims = {claim("a", 0, "xxx", 2)}, .layers = true});
  EXPECT_EQ(texts(result.segmentation), (Texts{"00022", "10444"}));
  EXPECT_EQ(result.claims[0].label, 4);
}

// On layer 1 the label 1 belongs to a segment that has no voxel: the claim must not become its voxels.
TEST(AssembleLabels, ALabelOfAnEmptySegmentOnAnotherLayerIsNotUsedEither) {
  Segmentation input = row({"12", "03"}, {"a", "b", "c"});
  Tissue empty = input.tissues[0];
  empty.name = empty.id = "empty";
  empty.layer = 1;
  empty.voxels = 0;
  input.emptyTissues.push_back(empty);
  const AssembledLabels result =
      assembleLabels(input, {.claims = {claim("b", 1, "x", 0), claim("a", 0, "x", 0)}, .layers = true});
  const auto& tissues = result.segmentation.tissues;
  EXPECT_TRUE(std::ranges::none_of(tissues, [](const Tissue& tissue) { return tissue.name == "empty"; }));
  EXPECT_TRUE(std::ranges::any_of(result.segmentation.emptyTissues,
                                  [](const Tissue& tissue) { return tissue.name == "empty"; }));
  EXPECT_EQ(result.claims[1].layer, 1);
  EXPECT_NE(result.claims[1].label, 1);
}

TEST(AssembleLabels, AClaimWithoutVoxelsIsKeptByName) {
  const AssembledLabels result = assembleLabels(row({"0112203"}), {.claims = {claim("a", 0, "000")}});
  EXPECT_EQ(texts(result.segmentation), Texts{"0002203"});
  ASSERT_EQ(result.segmentation.emptyTissues.size(), 1u);
  EXPECT_EQ(result.segmentation.emptyTissues[0].name, "a");
}

}  // namespace
}  // namespace sinew::repair
