#include "MeasureFidelity.h"
#include "VoxelMask.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/TestSupport/AnalyticDistance.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew {
namespace {

/// An octahedron of radius r about c, as eight tets around a node at c.
TetMesh octahedron(const Eigen::Vector3d& c, double r) {
  TetMesh mesh;
  mesh.nodes = {c};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1., -1.}) mesh.nodes.push_back(c + sign * r * Eigen::Vector3d::Unit(axis));
  for (std::int32_t x = 1; x <= 2; ++x)
    for (std::int32_t y = 3; y <= 4; ++y)
      for (std::int32_t z = 5; z <= 6; ++z) {
        const bool mirrored = (x + y + z) % 2 == 0;
        mesh.tets.push_back(mirrored ? Tet{0, y, x, z} : Tet{0, x, y, z});
      }
  mesh.labels.assign(8, 1);
  mesh.kinds.assign(7, NodeKind::Boundary);
  mesh.kinds[0] = NodeKind::Interior;
  return mesh;
}

/// A segmentation with one tissue, which has the voxels that `inside` says.
template <class Inside>
Segmentation labelled(const Eigen::Vector3i& size, const Inside& inside) {
  Segmentation segmentation;
  segmentation.geometry.size = size;
  segmentation.layers.emplace_back();
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x)
        segmentation.layers[0].push_back(inside(Eigen::Vector3i(x, y, z)) ? 1 : 0);
  updateTissueTable(segmentation);
  return segmentation;
}

TEST(MeasureFidelity, AnOctahedronInASphereIsExact) {
  const double r = 10;
  const Eigen::Vector3d c(12, 12, 12);
  // The level set's frame is turned and shifted against LPS, as for a tilted scan.
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translate(Eigen::Vector3d(5, -3, 2))
      .rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  const test::AnalyticSphere sphere(frame.inverse() * c, r);
  const Segmentation segmentation = labelled(Eigen::Vector3i::Constant(25), [&](const auto& i) {
    return (i.template cast<double>() - c).norm() < r;
  });
  LevelSetFromLabelsReport volumes;
  volumes.labelVolume = 1;
  volumes.levelSetVolume = 2;
  const TetMesh mesh = octahedron(c, r);
  const FidelityReport report =
      measureFidelity(mesh, meshBoundary(mesh).triangles, {.phi = sphere, .frame = frame}, volumes,
                      segmentation, segmentation.tissues.front());
  const double edge = r - r / std::sqrt(2), centroid = r - r / std::sqrt(3);
  EXPECT_NEAR(report.fidelity.maxBoundaryPhi, 0, 1e-13);
  EXPECT_NEAR(report.fidelity.surfaceMax, centroid, 1e-13);
  EXPECT_NEAR(report.fidelity.surfaceRms,
              std::sqrt((12 * edge * edge + 8 * centroid * centroid) / (6 + 12 + 8)), 1e-13);
  EXPECT_NEAR(report.fidelity.volume, 4. / 3 * r * r * r, 1e-10);
  EXPECT_EQ(report.fidelity.labelVolume, 1);
  EXPECT_EQ(report.fidelity.levelSetVolume, 2);
  // Voxel centres with |x|+|y|+|z| <= 10 about c, all inside of the ball but the six corners, which lie on
  // it.
  std::int64_t octahedral = 0;
  for (int x = -10; x <= 10; ++x)
    for (int y = -10; y <= 10; ++y)
      for (int z = -10; z <= 10; ++z) octahedral += std::abs(x) + std::abs(y) + std::abs(z) <= 10;
  const double ball = static_cast<double>(segmentation.tissues.front().voxels);
  const double diamond = static_cast<double>(octahedral);
  EXPECT_DOUBLE_EQ(report.fidelity.dice, 2 * (diamond - 6) / (ball + diamond));
  EXPECT_EQ(report.lost.components, 0);
}

TEST(MeasureFidelity, PiecesWithoutAVoxelInTheMeshAreLost) {
  TetMesh mesh = test::bccBlock(Eigen::Vector3i::Constant(3));
  for (Eigen::Vector3d& node : mesh.nodes) node = 3.3 * node + Eigen::Vector3d(2.1, 2.2, 2.3);
  const VoxelMask covered = voxelsInMesh(mesh, Eigen::Affine3d::Identity());
  const auto strayVoxel = [](const Eigen::Vector3i& i) { return i == Eigen::Vector3i(18, 18, 18); };
  const auto strayRow = [](const Eigen::Vector3i& i) { return i.x() == 17 && i.y() == 1 && i.z() < 3; };
  const Segmentation segmentation = labelled(Eigen::Vector3i::Constant(20), [&](const auto& i) {
    return covered.test(i) || strayVoxel(i) || strayRow(i);
  });
  const test::AnalyticSphere anywhere(Eigen::Vector3d::Zero(), 1);
  const FidelityReport report = measureFidelity(mesh, meshBoundary(mesh).triangles,
                                                {.phi = anywhere, .frame = Eigen::Isometry3d::Identity()}, {},
                                                segmentation, segmentation.tissues.front());
  EXPECT_EQ(report.lost.components, 2);
  EXPECT_DOUBLE_EQ(report.lost.volume, 4 * segmentation.geometry.voxelVolume());
  const auto n = static_cast<double>(covered.count());
  EXPECT_DOUBLE_EQ(report.fidelity.dice, 2 * n / (n + n + 4));
}

}  // namespace
}  // namespace sinew
