#include "WorstElements.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TEST(WorstElements, HaveTheirMeasureAndPlace) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, 0, -1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const MeshQuality quality = meshQuality(mesh);
  const std::vector<WorstElement> worst = worstElements(mesh, quality);
  ASSERT_EQ(worst.size(), 6u) << "both tets by three measures";
  EXPECT_EQ(worst[0].measure, "aspect_ratio");
  EXPECT_EQ(worst[0].element, 1);
  EXPECT_EQ(worst[0].value, quality.maxAspectRatio);
  EXPECT_EQ(worst[0].place, Eigen::Vector3d(1, 1, -0.25));
  EXPECT_EQ(worst[1].place, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(worst[2].measure, "min_dihedral_deg");
  EXPECT_EQ(worst[2].value, quality.minDihedralDeg);
  EXPECT_EQ(worst[4].measure, "max_dihedral_deg");
  EXPECT_EQ(worst[4].value, quality.maxDihedralDeg);
}

}  // namespace
}  // namespace sinew
