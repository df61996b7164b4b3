#include "Background.h"
#include "GoalMeasure.h"
#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/Compression.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

using Eigen::Vector3d;

TetMesh candidateOf(const SignedDistance& phi, double edgeLength, double maxOverEdge = 8) {
  const test::Background b = test::backgroundOf(phi, edgeLength, maxOverEdge);
  return extractMesh(b.mesh, selectCandidate(b.mesh, b.stars).keep, 1);
}

bool isListed(const CompressionReport& report, std::size_t node) {
  return std::ranges::count(report.unsnapped, static_cast<std::int32_t>(node)) > 0;
}

/// Every boundary node is on the surface as well as the options ask, or on the list.
void expectOnTheSurface(const TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& options,
                        const CompressionReport& report) {
  const double tolerance = options.surfaceTolerance * options.edgeLength * (1 + 1e-9);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (mesh.kinds[n] == NodeKind::Boundary && !isListed(report, n)) {
      EXPECT_LE(std::abs(phi.value(mesh.nodes[n])), tolerance) << "node " << n;
    }
  }
  for (const std::int32_t n : report.unsnapped) {
    EXPECT_EQ(mesh.kinds[n], NodeKind::Boundary);
    EXPECT_GT(std::abs(phi.value(mesh.nodes[n])), options.surfaceTolerance * options.edgeLength / 2);
  }
}

int tetsFarFromTheGoals(const TetMesh& mesh) {
  const auto& x = mesh.nodes;
  return static_cast<int>(
      std::ranges::count_if(mesh.tets, [&](const Tet& t) { return goalMeasure(t, x) > 1.02; }));
}

TEST(Compression, PutsTheBoundaryOfRandomShapesOnTheSurfaceAndInvertsNothing) {
  std::size_t unsnapped = 0;
  int farFromTheGoals = 0;
  for (unsigned seed = 0; seed < 18; ++seed) {
    const test::RandomShape shape = test::randomShape(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + shape.name());
    TetMesh mesh = candidateOf(shape, 2);
    const TetMesh before = mesh;
    const CompressionOptions options{.edgeLength = 2};
    const CompressionReport report = compressOntoSurface(mesh, shape, options);
    EXPECT_EQ(meshQuality(mesh).inverted, 0);
    EXPECT_EQ(mesh.tets, before.tets);
    EXPECT_EQ(mesh.kinds, before.kinds);
    EXPECT_EQ(mesh.nodes.size(), before.nodes.size());
    expectOnTheSurface(mesh, shape, options, report);
    unsnapped += report.unsnapped.size();
    farFromTheGoals += tetsFarFromTheGoals(mesh);
  }
  // A few are left to the repair. Of 37,000 tets 10 stay far from the goals; 26 do without the last descent,
  // 31 without the cap on the snap.
  EXPECT_LE(unsnapped, 10u);
  EXPECT_LE(farFromTheGoals, 18);
}

TEST(Compression, MeetsTheToleranceAskedFor) {
  const test::AnalyticTorus torus({0.1, 0.2, 0.3}, 5, 2);
  for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
    TetMesh mesh = candidateOf(torus, 1);
    const CompressionOptions options{.edgeLength = 1, .surfaceTolerance = tolerance};
    const CompressionReport report = compressOntoSurface(mesh, torus, options);
    EXPECT_TRUE(report.unsnapped.empty());
    EXPECT_LE(report.snapSweeps, options.snapSweeps);
    expectOnTheSurface(mesh, torus, options, report);
  }
}

TEST(Compression, ListsTheNodesThatCannotReachTheSurface) {
  // The candidate of a ball of 6 mm cannot shrink onto one of 2 mm without crushing its tets.
  TetMesh mesh = candidateOf(test::AnalyticSphere(Vector3d::Zero(), 6), 1);
  const test::AnalyticSphere small(Vector3d::Zero(), 2);
  const CompressionOptions options{.edgeLength = 1, .snapSweeps = 2};
  const CompressionReport report = compressOntoSurface(mesh, small, options);
  EXPECT_FALSE(report.unsnapped.empty());
  EXPECT_EQ(report.snapSweeps, 2);
  EXPECT_TRUE(std::ranges::is_sorted(report.unsnapped));
  EXPECT_EQ(meshQuality(mesh).inverted, 0);
  expectOnTheSurface(mesh, small, options, report);
}

TEST(Compression, ListsNodesOfTheMeshForARegionToo) {
  TetMesh mesh = candidateOf(test::AnalyticSphere(Vector3d::Zero(), 5), 1);
  const test::AnalyticSphere small(Vector3d::Zero(), 2);
  std::vector<std::uint8_t> region(mesh.nodes.size());
  for (std::size_t n = 0; n < region.size(); ++n) region[n] = mesh.nodes[n].z() > 2;
  const CompressionReport report =
      compressOntoSurface(mesh, small, {.edgeLength = 1, .snapSweeps = 1}, region);
  EXPECT_FALSE(report.unsnapped.empty());
  for (const std::int32_t n : report.unsnapped) {
    EXPECT_TRUE(region[n]);
    EXPECT_EQ(mesh.kinds[n], NodeKind::Boundary);
    EXPECT_GT(std::abs(small.value(mesh.nodes[n])), 1e-5);
  }
}

TEST(Compression, MovesOnlyTheRegion) {
  const test::AnalyticSphere sphere({0.1, 0.2, 0.3}, 5);
  TetMesh mesh = candidateOf(sphere, 1);
  const TetMesh before = mesh;
  std::vector<std::uint8_t> region(mesh.nodes.size());
  for (std::size_t n = 0; n < region.size(); ++n) region[n] = mesh.nodes[n].z() > 0;
  const CompressionOptions options{.edgeLength = 1};
  const CompressionReport report = compressOntoSurface(mesh, sphere, options, region);
  EXPECT_EQ(meshQuality(mesh).inverted, 0);
  int moved = 0;
  for (std::size_t n = 0; n < region.size(); ++n) {
    if (!region[n]) {
      ASSERT_EQ(mesh.nodes[n], before.nodes[n]);
    } else if (mesh.kinds[n] == NodeKind::Boundary && !isListed(report, n)) {
      EXPECT_LE(std::abs(sphere.value(mesh.nodes[n])), options.surfaceTolerance);
      ++moved;
    }
  }
  EXPECT_GT(moved, 50);
}

TEST(Compression, LeavesTheLatticeDeepInsideAlone) {
  const test::AnalyticSphere sphere({0.1, 0.2, 0.3}, 7);
  TetMesh mesh = candidateOf(sphere, 1, 1);  // one size: no green tets
  const TetMesh before = mesh;
  compressOntoSurface(mesh, sphere, {.edgeLength = 1});
  int deep = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (sphere.value(before.nodes[n]) > -6) continue;  // six rings or more below the boundary
    EXPECT_EQ(mesh.nodes[n], before.nodes[n]);
    ++deep;
  }
  EXPECT_GT(deep, 5);
}

TEST(Compression, OfNothingDoesNothing) {
  TetMesh mesh;
  const test::AnalyticSphere sphere(Vector3d::Zero(), 1);
  EXPECT_TRUE(compressOntoSurface(mesh, sphere, {.edgeLength = 1}).unsnapped.empty());
  EXPECT_TRUE(mesh.nodes.empty());
}

TEST(Compression, SameBitsForAnyNumberOfThreads) {
  // Large enough for several tasks per colour.
  const test::AnalyticTorus torus({0.1, 0.2, 0.3}, 7, 3);
  const TetMesh candidate = candidateOf(torus, 0.8);
  const auto withThreads = [&](std::size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    TetMesh mesh = candidate;
    compressOntoSurface(mesh, torus, {.edgeLength = 0.8});
    return mesh.nodes;
  };
  const std::vector<Vector3d> one = withThreads(1);
  EXPECT_GT(one.size(), 5000u);
  EXPECT_EQ(withThreads(4), one);
}

}  // namespace
}  // namespace sinew
