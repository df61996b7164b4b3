#include "sinew/MeshIO/CombineMeshes.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

/// One tet per label, side by side.
TissueMesh tetsOf(const std::vector<TissueRegion>& regions) {
  TissueMesh made;
  for (const TissueRegion& region : regions) {
    const auto first = static_cast<std::int32_t>(made.mesh.nodes.size());
    for (const Eigen::Vector3d& node : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                        Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
      made.mesh.nodes.push_back(node);
    made.mesh.kinds.resize(made.mesh.nodes.size(), NodeKind::Boundary);
    made.mesh.tets.push_back({first, first + 1, first + 2, first + 3});
    made.mesh.labels.push_back(region.label);
  }
  made.regions = regions;
  return made;
}

std::vector<std::int32_t> labelsOf(const std::vector<TissueRegion>& regions) {
  std::vector<std::int32_t> labels;
  for (const TissueRegion& region : regions) labels.push_back(region.label);
  return labels;
}

TEST(CombineMeshes, KeepsNodesNamesColoursAndLabels) {
  const TissueMesh all =
      combineMeshes({tetsOf({{7, "femur", {1, 0, 0}}}), tetsOf({{3, "tibia", {0, 1, 0}}})});
  EXPECT_EQ(all.mesh.nodes.size(), 8u);
  EXPECT_EQ(all.mesh.kinds.size(), 8u);
  EXPECT_EQ(all.mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(all.mesh.labels, (std::vector<std::int32_t>{7, 3}));
  ASSERT_EQ(all.regions.size(), 2u);
  EXPECT_EQ(all.regions[1].name, "tibia");
  EXPECT_EQ(all.regions[1].color, (std::array<double, 3>{0, 1, 0}));
}

TEST(CombineMeshes, ALabelThatIsTakenBecomesTheSmallestThatNobodyUses) {
  const TissueMesh all = combineMeshes(
      {tetsOf({{1, "a"}, {2, "b"}}), tetsOf({{1, "c"}, {4, "d"}}), tetsOf({{2, "e"}, {3, "f"}})});
  EXPECT_EQ(labelsOf(all.regions), (std::vector<std::int32_t>{1, 2, 5, 4, 6, 3}));
  EXPECT_EQ(all.mesh.labels, (std::vector<std::int32_t>{1, 2, 5, 4, 6, 3}));
}

TEST(CombineMeshes, ArraysStayThatAllHave) {
  TissueMesh a = tetsOf({{1, "a"}}), b = tetsOf({{2, "b"}});
  a.arrays.cells = {{"one", {1}}, {"both", {2}}, {"differ", {1, 2, 3}, 3}};
  b.arrays.cells = {{"both", {3}}, {"differ", {1}}};
  a.arrays.points = {{"phi", {0, 1, 2, 3}}};
  const TissueMesh all = combineMeshes({a, b});
  ASSERT_EQ(all.arrays.cells.size(), 1u);
  EXPECT_EQ(all.arrays.cells[0].name, "both");
  EXPECT_EQ(all.arrays.cells[0].values, (std::vector<float>{2, 3}));
  EXPECT_TRUE(all.arrays.points.empty());
}

TEST(CombineMeshes, OneIsLeftAsItIs) {
  EXPECT_EQ(combineMeshes({tetsOf({{5, "a"}})}).mesh.labels, std::vector<std::int32_t>{5});
  EXPECT_TRUE(combineMeshes({}).mesh.tets.empty());
}

}  // namespace
}  // namespace sinew
