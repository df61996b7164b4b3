#include "GoalMeasure.h"
#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Mesher/MoveBoundary.h"
#include "sinew/TestSupport/AnalyticDistance.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

namespace sinew {
namespace {

TetMesh meshOf(const SignedDistance& phi, double edge) {
  GenerateTetMeshOptions options;
  options.edgeLength = edge;
  return generateTetMesh(phi, options);
}

double worst(const TetMesh& mesh, const std::vector<Eigen::Vector3d>& x) {
  double measure = 0;
  for (const Tet& tet : mesh.tets) measure = std::max(measure, goalMeasure(tet, x));
  return measure;
}

TEST(MoveBoundary, OfABallGoesOutwards) {
  const test::AnalyticSphere ball({0.2, 0.1, -0.3}, 8);
  const TetMesh mesh = meshOf(ball, 2);
  for (const double offset : {0.04, -0.04}) {
    const std::vector<Eigen::Vector3d> moved = moveBoundary(mesh, ball, offset);
    int boundary = 0, there = 0;
    for (std::size_t n = 0; n < moved.size(); ++n) {
      if (mesh.kinds[n] == NodeKind::Interior) {
        EXPECT_EQ(moved[n], mesh.nodes[n]);
        continue;
      }
      ++boundary;
      const double phi = ball.value(moved[n]);
      const bool moves = moved[n] != mesh.nodes[n];
      EXPECT_NEAR(phi, moves ? offset : 0, 0.002 + 1e-4 * std::abs(offset)) << "the mesh's own tolerance";
      there += moves;
    }
    EXPECT_GT(there, 0.98 * boundary) << "a ball has few tets at the bounds";
  }
}

TEST(MoveBoundary, NoTetGetsWorseThanTheBounds) {
  int stayed = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const test::RandomShape shape = test::randomShape(seed);
    const TetMesh mesh = meshOf(shape, 2);
    for (const double offset : {-0.2, 0.05, 0.2}) {
      const std::vector<Eigen::Vector3d> moved = moveBoundary(mesh, shape, offset);
      EXPECT_LE(worst(mesh, moved), std::max(1., worst(mesh, mesh.nodes)))
          << "seed " << seed << ", " << offset;
      for (std::size_t n = 0; n < moved.size(); ++n)
        stayed += mesh.kinds[n] == NodeKind::Boundary && moved[n] == mesh.nodes[n];
    }
  }
  EXPECT_GT(stayed, 0) << "these shapes are no test";
}

TEST(MoveBoundary, IsTheSameForAnyNumberOfThreads) {
  const test::AnalyticTorus torus({0, 0, 0}, 8, 3);
  const TetMesh mesh = meshOf(torus, 2);
  const auto withThreads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return moveBoundary(mesh, torus, 0.1);
  };
  EXPECT_TRUE(withThreads(1) == withThreads(4));
}

}  // namespace
}  // namespace sinew
