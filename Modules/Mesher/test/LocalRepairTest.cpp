#include "Background.h"
#include "LocalRepair.h"
#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

namespace sinew {
namespace {

using test::Background;
using test::backgroundOf;

constexpr double kEdge = 1.5;

/// Tets beyond what the repair tolerates.
std::ptrdiff_t badTets(const TetMesh& mesh) {
  const auto& x = mesh.nodes;
  return std::ranges::count_if(mesh.tets, [&](const Tet& t) {
    const TetQuality q = tetQuality(x[t[0]], x[t[1]], x[t[2]], x[t[3]]);
    return q.aspectRatio > 3.5 || q.minDihedralDeg < 25 || q.maxDihedralDeg > 140;
  });
}

TEST(LocalRepair, MendsMostOfWhatTheCompressionLeaves) {
  std::ptrdiff_t before = 0, after = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const test::RandomShape shape = test::randomShape(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + shape.name());
    const Background b = backgroundOf(shape, kEdge);
    const Candidate candidate = selectCandidate(b.mesh, b.stars);
    TetMesh compressed = extractMesh(b.mesh, candidate.keep, 1);
    const CompressionReport plain = compressOntoSurface(compressed, shape, {.edgeLength = kEdge});
    LocalRepairReport report;
    const TetMesh mesh =
        compressAndRepair(b.mesh, b.stars, candidate, shape, {.edgeLength = kEdge, .label = 3}, &report);

    EXPECT_TRUE(meshConditions(mesh).good());
    EXPECT_EQ(meshQuality(mesh).inverted, 0);
    EXPECT_EQ(mesh.labels, std::vector<std::int32_t>(mesh.tets.size(), 3));
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      if (mesh.kinds[n] == NodeKind::Interior) continue;
      ASSERT_LE(std::abs(shape.value(mesh.nodes[n])), 1e-5 * kEdge);
    }
    EXPECT_LE(report.accepted, report.tried);
    if (report.accepted == 0 && plain.unsnapped.empty()) {
      EXPECT_EQ(mesh.tets, compressed.tets);
      EXPECT_EQ(mesh.nodes, compressed.nodes);
    }
    before += badTets(compressed) + std::ssize(plain.unsnapped);
    after += badTets(mesh);
  }
  EXPECT_GT(before, 50) << "these shapes are no test";
  EXPECT_LT(after, before / 4);
}

TEST(LocalRepair, TheSameForAnyNumberOfThreads) {
  std::int64_t accepted = 0;
  for (unsigned seed = 5; seed < 9; ++seed) {
    const test::RandomShape shape = test::randomShape(seed);
    const Background b = backgroundOf(shape, kEdge);
    const Candidate candidate = selectCandidate(b.mesh, b.stars);
    TetMesh first;
    for (const std::size_t threads : {1, 2, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      LocalRepairReport report;
      const TetMesh mesh =
          compressAndRepair(b.mesh, b.stars, candidate, shape, {.edgeLength = kEdge}, &report);
      accepted += report.accepted;
      if (first.tets.empty()) first = mesh;
      EXPECT_EQ(mesh.nodes, first.nodes) << "seed " << seed << ", " << threads << " threads";
      EXPECT_EQ(mesh.tets, first.tets) << "seed " << seed << ", " << threads << " threads";
    }
  }
  EXPECT_GT(accepted, 0) << "these shapes need no repair";
}

}  // namespace
}  // namespace sinew
