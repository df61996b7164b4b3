#include "LevelSetSurface.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetFromTriangles.h"
#include "sinew/MeshIO/TriangleFile.h"
#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace sinew {
namespace {

namespace fs = std::filesystem;

double longestSide(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& node : mesh.nodes) box.extend(node);
  return box.sizes().maxCoeff();
}

/// The dragon of Teran et al. 2005, who reached 500 K tets with AR 5.3 at most and 2.3 on average, angles of
/// 16 to 150 degrees, longest over shortest edge 94.
TEST(Dragon, IsAheadOfThePapersOwn) {
  const char* data = std::getenv("SINEW_TEST_DATA");
  const fs::path file = fs::path(data ? data : "") / "meshes/dragon/dragon.obj";
  if (!fs::exists(file)) GTEST_SKIP() << "SINEW_TEST_DATA names no folder with meshes/dragon/dragon.obj";

  const TriangleMesh triangles = readTriangleMesh(file);
  const double side = longestSide(triangles);  // the file has no unit
  LevelSetFromTrianglesReport made;
  const LevelSet levelSet = levelSetFromTriangles({triangles.nodes, triangles.triangles},
                                                  {.spacing = side / 400, .bandVoxels = 7}, &made);
  const LevelSetSurface surface(fieldFromLevelSet(levelSet));
  GenerateTetMeshOptions options;
  options.edgeLength = side / 95;  // about 500 K tets where all of the surface has this size
  options.curvature = 0;
  const TetMesh mesh = generateTetMesh(surface, options);

  const MeshQuality quality = meshQuality(mesh);
  std::cout << quality.tets << " tets, AR " << quality.maxAspectRatio << " at most and "
            << quality.meanAspectRatio << " on average, angles of " << quality.minDihedralDeg << " to "
            << quality.maxDihedralDeg << " degrees, longest over shortest edge " << quality.maxOverMinEdge
            << '\n';
  EXPECT_NEAR(static_cast<double>(quality.tets), 500e3, 50e3);
  EXPECT_LE(quality.maxAspectRatio, 3.6);
  EXPECT_LE(quality.meanAspectRatio, 1.8);
  EXPECT_GE(quality.minDihedralDeg, 25);
  EXPECT_LE(quality.maxDihedralDeg, 138);
  EXPECT_EQ(quality.inverted, 0);
  EXPECT_TRUE(meshConditions(mesh).good());
  EXPECT_NEAR(made.levelSetVolume, made.surfaceVolume, 0.002 * made.surfaceVolume);
  EXPECT_NEAR(quality.volume, made.surfaceVolume, 0.005 * made.surfaceVolume);
}

}  // namespace
}  // namespace sinew
