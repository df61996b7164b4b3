#include "VoxelMask.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

namespace sinew {
namespace {

Eigen::Affine3d scaledAndShifted(double scale, const Eigen::Vector3d& shift) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.translate(shift).scale(scale);
  return map;
}

TEST(VoxelMask, RunsCrossWords) {
  VoxelMask mask({Eigen::Vector3i(-3, 0, 0), Eigen::Vector3i(200, 2, 2)});
  mask.addRun(-3, 61, 0, 0);
  mask.addRun(60, 199, 1, 1);
  EXPECT_EQ(mask.count(), 65 + 140);
  EXPECT_TRUE(mask.test({-3, 0, 0}));
  EXPECT_TRUE(mask.test({61, 0, 0}));
  EXPECT_FALSE(mask.test({62, 0, 0}));
  EXPECT_FALSE(mask.test({59, 1, 1}));
  EXPECT_TRUE(mask.test({199, 1, 1}));
  EXPECT_FALSE(mask.test({0, 2, 0})) << "outside of the box";
}

TEST(VoxelMask, ATetHoldsTheVoxelsThatBarycentricCoordinatesSay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-6, 6);
  for (int trial = 0; trial < 50; ++trial) {
    TetMesh mesh;
    for (int n = 0; n < 4; ++n) mesh.nodes.emplace_back(uniform(random), uniform(random), uniform(random));
    mesh.tets = {{0, 1, 2, 3}};
    const VoxelMask mask = voxelsInMesh(mesh, Eigen::Affine3d::Identity());
    Eigen::Matrix3d edges;
    edges << mesh.nodes[1] - mesh.nodes[0], mesh.nodes[2] - mesh.nodes[0], mesh.nodes[3] - mesh.nodes[0];
    for (int z = -6; z <= 6; ++z)
      for (int y = -6; y <= 6; ++y)
        for (int x = -6; x <= 6; ++x) {
          const Eigen::Vector3d weights = edges.inverse() * (Eigen::Vector3d(x, y, z) - mesh.nodes[0]);
          const double least = std::min(weights.minCoeff(), 1 - weights.sum());
          if (std::abs(least) < 1e-6) continue;  // on the boundary the two roundings may disagree
          ASSERT_EQ(mask.test({x, y, z}), least > 0)
              << "seed 7, trial " << trial << ": " << x << " " << y << " " << z;
        }
  }
}

TEST(VoxelMask, SharedFacesLeaveNoGap) {
  // Voxel centres lie exactly on nodes, edges and faces of the lattice: every one of the inner ones counts
  // once.
  const TetMesh block = test::bccBlock(Eigen::Vector3i::Constant(6));
  const VoxelMask mask = voxelsInMesh(block, scaledAndShifted(2, Eigen::Vector3d(10, -20, 30)));
  for (int z = 2; z <= 10; ++z)
    for (int y = 2; y <= 10; ++y)
      for (int x = 2; x <= 10; ++x)
        EXPECT_TRUE(mask.test({x + 10, y - 20, z + 30})) << x << " " << y << " " << z;
}

TEST(VoxelMask, CountIsTheVolume) {
  const TetMesh block = test::bccBlock(Eigen::Vector3i::Constant(4));
  const double scale = 20.37;  // voxels per cube; the offset keeps centres off the faces
  const VoxelMask mask = voxelsInMesh(block, scaledAndShifted(scale, Eigen::Vector3d(0.123, 0.456, 0.789)));
  const double volume = static_cast<double>(block.tets.size()) / 12 * scale * scale * scale;
  // The bound for the error of counting is the surface layer; these many voxels average it down to well below
  // 1 %.
  EXPECT_NEAR(static_cast<double>(mask.count()) / volume, 1, 0.005);
}

TEST(VoxelMask, MirroredImagesGiveTheSameVoxels) {
  const TetMesh block = test::bccBlock(Eigen::Vector3i(3, 2, 2));
  const Eigen::Affine3d map = scaledAndShifted(3.3, Eigen::Vector3d(0.1, 0.2, 0.3));
  Eigen::Affine3d mirrored = Eigen::Affine3d::Identity();
  mirrored.scale(Eigen::Vector3d(-1, 1, 1));
  const VoxelMask mask = voxelsInMesh(block, map), image = voxelsInMesh(block, mirrored * map);
  EXPECT_EQ(mask.count(), image.count());
  for (int x = 0; x < 12; ++x) EXPECT_EQ(mask.test({x, 3, 3}), image.test({-x, 3, 3})) << x;
}

}  // namespace
}  // namespace sinew
