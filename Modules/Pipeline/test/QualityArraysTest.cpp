#include "QualityArrays.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/TestSupport/AnalyticDistance.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sinew {
namespace {

TEST(QualityArrays, HoldTheQualityOfEveryTetAndTheLevelSetAtEveryNode) {
  TetMesh mesh = test::bccBlock({3, 3, 3});
  mesh.nodes[0] += Eigen::Vector3d(0.2, 0.1, 0.05);
  const test::AnalyticSphere sphere({1, 2, 3}, 5);
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translate(Eigen::Vector3d(10, 20, 30)).rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  const MeshArrays arrays = qualityArrays(mesh, sphere, frame);
  ASSERT_EQ(arrays.cells.size(), 3u);
  const char* names[]{"aspect_ratio", "min_dihedral_deg", "max_dihedral_deg"};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(arrays.cells[i].name, names[i]);
    EXPECT_EQ(arrays.cells[i].values.size(), mesh.tets.size());
  }
  const MeshQuality quality = meshQuality(mesh);
  EXPECT_EQ(std::ranges::max(arrays.cells[0].values), static_cast<float>(quality.maxAspectRatio));
  EXPECT_EQ(std::ranges::min(arrays.cells[1].values), static_cast<float>(quality.minDihedralDeg));
  EXPECT_EQ(std::ranges::max(arrays.cells[2].values), static_cast<float>(quality.maxDihedralDeg));
  ASSERT_EQ(arrays.points.size(), 1u);
  EXPECT_EQ(arrays.points[0].name, "phi");
  const Eigen::Vector3d centre = frame * Eigen::Vector3d(1, 2, 3);
  // Single precision at 40 mm.
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    EXPECT_NEAR(arrays.points[0].values[n], (mesh.nodes[n] - centre).norm() - 5, 1e-5);
}

}  // namespace
}  // namespace sinew
