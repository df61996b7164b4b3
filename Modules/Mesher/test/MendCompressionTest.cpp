#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/MendCompression.h"
#include "sinew/TestSupport/AnalyticDistance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr double kMendedEdge = 1;
constexpr TetBounds kBounds{5, 17, 147};

const test::AnalyticSphere& ball() {
  static const test::AnalyticSphere shape({0.1, 0.2, 0.3}, 6);
  return shape;
}

TetMesh compressedBall() {
  GenerateTetMeshOptions options;
  options.edgeLength = kMendedEdge;
  return generateTetMesh(ball(), options);
}

std::int64_t tetsBeyond(const TetBounds& bounds, const TetMesh& mesh) {
  const auto& x = mesh.nodes;
  return std::ranges::count_if(mesh.tets, [&](const Tet& t) {
    return bounds.exceededBy(tetQuality(x[t[0]], x[t[1]], x[t[2]], x[t[3]]));
  });
}

/// Moves a node towards the opposite face of its first tet until that is flat but for a twentieth.
void flatten(TetMesh& mesh, std::int32_t node) {
  const auto tet = *std::ranges::find_if(mesh.tets, [&](const Tet& t) { return t[0] == node; });
  auto& x = mesh.nodes;
  x[node] += 0.9 * ((x[tet[1]] + x[tet[2]] + x[tet[3]]) / 3 - x[node]);
}

std::int32_t firstInteriorNode(const TetMesh& mesh) {
  for (const Tet& tet : mesh.tets)
    if (std::ranges::all_of(tet, [&](std::int32_t v) { return mesh.kinds[v] == NodeKind::Interior; }))
      return tet[0];
  return -1;
}

TEST(MendCompression, MovesNothingInAGoodMesh) {
  TetMesh mesh = compressedBall();
  const auto before = mesh.nodes;
  const MendReport report = mendCompression(mesh, ball(), {.edgeLength = kMendedEdge}, kBounds);
  EXPECT_EQ(report.tets, 0);
  EXPECT_EQ(report.nodes, 0);
  EXPECT_EQ(mesh.nodes, before);
}

TEST(MendCompression, MendsABadTetAndMovesOnlyWhatIsNear) {
  TetMesh mesh = compressedBall();
  const std::int32_t node = firstInteriorNode(mesh);
  ASSERT_GE(node, 0);
  flatten(mesh, node);
  const auto before = mesh.nodes;
  ASSERT_GT(tetsBeyond(kBounds, mesh), 0);
  const std::int64_t bad = tetsBeyond(kBounds, mesh);
  const MendReport report = mendCompression(mesh, ball(), {.edgeLength = kMendedEdge}, kBounds);
  EXPECT_EQ(report.tets, bad);
  EXPECT_EQ(tetsBeyond(kBounds, mesh), 0);
  EXPECT_TRUE(report.compression.unsnapped.empty());
  for (std::size_t n = 0; n < before.size(); ++n) {
    // The star of the node, and two rings around it, of edges of up to an edge length.
    if ((before[n] - before[node]).norm() > 5 * kMendedEdge) {
      EXPECT_EQ(mesh.nodes[n], before[n]);
    }
  }
}

TEST(MendCompression, PutsNodesBackOntoTheSurface) {
  TetMesh mesh = compressedBall();
  const auto node =
      static_cast<std::size_t>(std::ranges::find(mesh.kinds, NodeKind::Boundary) - mesh.kinds.begin());
  const Vector3d inwards = (Vector3d(0.1, 0.2, 0.3) - mesh.nodes[node]).normalized();
  mesh.nodes[node] += 0.1 * kMendedEdge * inwards;
  const CompressionOptions options{.edgeLength = kMendedEdge};
  const MendReport report = mendCompression(mesh, ball(), options, kBounds);
  EXPECT_GT(report.nodes, 0);
  EXPECT_LE(std::abs(ball().value(mesh.nodes[node])), options.surfaceTolerance * kMendedEdge);
}

}  // namespace
}  // namespace sinew
