#include "sinew/Segmentation/LabelComponents.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3i;

Segmentation makeImage(const Vector3i& size, std::vector<std::int32_t> voxels) {
  Segmentation image;
  image.geometry.size = size;
  image.layers.push_back(std::move(voxels));
  updateTissueTable(image);
  return image;
}

/// Sizes of the pieces by a flood fill over the 26 neighbours, largest first.
std::vector<std::int64_t> floodFill(const Segmentation& image, std::int32_t label) {
  std::vector<std::int32_t> left = image.layers[0];
  const Vector3i size = image.geometry.size;
  const auto offset = [&](const Vector3i& i) { return i.x() + size.x() * (i.y() + size.y() * i.z()); };
  std::vector<std::int64_t> sizes;
  for (int start = 0; start < std::ssize(left); ++start) {
    if (left[start] != label) continue;
    sizes.push_back(0);
    std::vector<Vector3i> stack{{start % size.x(), start / size.x() % size.y(), start / size.x() / size.y()}};
    left[start] = 0;
    while (!stack.empty()) {
      const Vector3i at = stack.back();
      stack.pop_back();
      ++sizes.back();
      for (int n = 0; n < 27; ++n) {
        const Vector3i next = at + Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        if ((next.array() < 0).any() || (next.array() >= size.array()).any()) continue;
        if (left[offset(next)] != label) continue;
        left[offset(next)] = 0;
        stack.push_back(next);
      }
    }
  }
  std::ranges::sort(sizes, std::greater{});
  return sizes;
}

TEST(LabelComponents, CornersConnect) {
  std::vector<std::int32_t> voxels(27, 0);
  voxels[0] = voxels[13] = voxels[26] = 5;  // the diagonal of a cube
  const Segmentation image = makeImage({3, 3, 3}, voxels);
  EXPECT_EQ(labelComponents(image, image.tissues[0]).voxels, std::vector<std::int64_t>{3});
}

TEST(LabelComponents, AllTwentySixNeighboursConnect) {
  for (int n = 0; n < 27; ++n) {
    std::vector<std::int32_t> voxels(27, 0);
    voxels[13] = voxels[n] = 5;
    const Segmentation image = makeImage({3, 3, 3}, voxels);
    EXPECT_EQ(labelComponents(image, image.tissues[0]).voxels.size(), 1u) << n;
  }
}

TEST(LabelComponents, AGapSeparatesAndOtherLabelsDoNotBridgeIt) {
  const Segmentation image = makeImage({5, 1, 1}, {7, 2, 7, 7, 2});
  const LabelComponents sevens = labelComponents(image, image.tissues[1]);
  EXPECT_EQ(sevens.voxels, (std::vector<std::int64_t>{2, 1}));
  EXPECT_EQ(sevens.at({0, 0, 0}), 1);  // largest first
  EXPECT_EQ(sevens.at({1, 0, 0}), -1);
  EXPECT_EQ(sevens.at({2, 0, 0}), 0);
  EXPECT_EQ(sevens.at({3, 0, 0}), 0);
}

TEST(LabelComponents, OutsideTheBoxIsNoPiece) {
  const Segmentation image = makeImage({4, 1, 1}, {0, 3, 3, 0});
  const LabelComponents pieces = labelComponents(image, image.tissues[0]);
  EXPECT_EQ(pieces.ids.size(), 2u);
  for (const Vector3i& outside :
       {Vector3i(0, 0, 0), Vector3i(3, 0, 0), Vector3i(-1, 0, 0), Vector3i(1, 1, 0)})
    EXPECT_EQ(pieces.at(outside), -1);
}

TEST(LabelComponents, APieceThatMeetsItselfLateIsOne) {
  // Two prongs that join only in the last row, listed as two runs in every row before.
  const Segmentation image = makeImage({3, 3, 1}, {1, 0, 1, 1, 0, 1, 1, 1, 1});
  EXPECT_EQ(labelComponents(image, image.tissues[0]).voxels, std::vector<std::int64_t>{7});
}

TEST(LabelComponents, ReadTheTissuesOwnLayer) {
  Segmentation image = makeImage({3, 1, 1}, {1, 1, 1});
  image.layers.push_back({1, 0, 1});
  updateTissueTable(image);
  ASSERT_EQ(image.tissues.size(), 2u);
  EXPECT_EQ(labelComponents(image, image.tissues[0]).voxels, std::vector<std::int64_t>{3});
  EXPECT_EQ(labelComponents(image, image.tissues[1]).voxels, (std::vector<std::int64_t>{1, 1}));
}

TEST(LabelComponents, OfNoVoxelsAreNone) {
  const Segmentation image = makeImage({3, 1, 1}, {1, 1, 1});
  const LabelComponents pieces = labelComponents(image, Tissue{});
  EXPECT_TRUE(pieces.voxels.empty());
  EXPECT_EQ(pieces.at({0, 0, 0}), -1);
}

TEST(LabelComponents, AgreeWithAFloodFillOnNoise) {
  std::mt19937 random(11);
  for (const std::uint32_t percent : {2, 5, 8, 12, 30, 60}) {
    std::vector<std::int32_t> voxels(17 * 13 * 11);
    for (std::int32_t& voxel : voxels) voxel = random() % 100 < percent ? 4 : 0;
    const Segmentation image = makeImage({17, 13, 11}, voxels);
    const LabelComponents pieces = labelComponents(image, image.tissues.at(0));
    EXPECT_EQ(pieces.voxels, floodFill(image, 4)) << percent << " %, seed 11";
    for (std::size_t id = 0; id < pieces.voxels.size(); ++id)
      EXPECT_EQ(std::ranges::count(pieces.ids, std::int32_t(id)), pieces.voxels[id]);
  }
}

}  // namespace
}  // namespace sinew
