#include "sinew/Mesher/GenerateTetMesh.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr double kMaxAspectRatio = 4.5;  // what the program promises for any mesh that it hands out
constexpr double kMinDihedralDeg = 18, kMaxDihedralDeg = 145;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMaxBoundaryPhi = 1e-3;  // edge lengths

GenerateTetMeshOptions withEdge(double edgeLength) {
  GenerateTetMeshOptions options;
  options.edgeLength = edgeLength;
  return options;
}

void expectSound(const TetMesh& mesh, const SignedDistance& phi, double edgeLength) {
  const MeshQuality q = meshQuality(mesh);
  EXPECT_EQ(q.inverted, 0);
  EXPECT_LE(q.maxAspectRatio, kMaxAspectRatio);
  EXPECT_GE(q.minDihedralDeg, kMinDihedralDeg);
  EXPECT_LE(q.maxDihedralDeg, kMaxDihedralDeg);
  EXPECT_TRUE(meshConditions(mesh).good());
  ASSERT_EQ(mesh.kinds.size(), mesh.nodes.size());
  ASSERT_EQ(mesh.labels.size(), mesh.tets.size());
  double largestPhi = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.kinds[n] == NodeKind::Boundary)
      largestPhi = std::max(largestPhi, std::abs(phi.value(mesh.nodes[n])));
  EXPECT_LE(largestPhi, kMaxBoundaryPhi * edgeLength);
}

/// How far a mesh is from its shape; all three shrink with the square of the edge length.
struct Errors {
  double volume = 0;  ///< relative
  double area = 0;    ///< relative
  double radius = 0;  ///< rms of phi at the triangles' centroids, mm
};

template <class Shape>
Errors errorsOf(const Shape& shape, const TetMesh& mesh) {
  double area = 0, squares = 0;
  for (const auto& [a, b, c] : meshBoundary(mesh).triangles) {
    const Vector3d &A = mesh.nodes[a], &B = mesh.nodes[b], &C = mesh.nodes[c];
    const double triangle = (B - A).cross(C - A).norm() / 2, phi = shape.value((A + B + C) / 3);
    area += triangle;
    squares += triangle * phi * phi;
  }
  return {std::abs(meshQuality(mesh).volume / shape.volume() - 1), std::abs(area / shape.area() - 1),
          std::sqrt(squares / area)};
}

template <class Shape>
void expectSecondOrder(const Shape& shape, const std::array<double, 3>& edges, std::int64_t euler) {
  std::array<Errors, 3> errors;
  for (int k = 0; k < 3; ++k) {
    SCOPED_TRACE(edges[k]);
    // One size everywhere: refinement by curvature would change the ratio of the sizes.
    GenerateTetMeshOptions options = withEdge(edges[k]);
    options.curvature = 0;
    const TetMesh mesh = generateTetMesh(shape, options);
    expectSound(mesh, shape, edges[k]);
    EXPECT_LE(meshQuality(mesh).meanAspectRatio, 2.1);
    EXPECT_EQ(meshTopology(mesh).components, 1);
    EXPECT_EQ(meshTopology(mesh).boundaryComponents, 1);
    EXPECT_EQ(meshTopology(mesh).eulerCharacteristic, euler);
    errors[k] = errorsOf(shape, mesh);
  }
  const auto order = [&](double coarse, double fine) {
    return std::log(coarse / fine) / std::log(edges[0] / edges[2]);
  };
  EXPECT_GE(order(errors[0].volume, errors[2].volume), 1.8);
  EXPECT_GE(order(errors[0].area, errors[2].area), 1.8);
  EXPECT_GE(order(errors[0].radius, errors[2].radius), 1.8);
  for (int k = 1; k < 3; ++k) EXPECT_LT(errors[k].volume, errors[k - 1].volume);
  EXPECT_LE(errors[2].volume, 0.01);
  EXPECT_LE(errors[2].area, 0.01);
}

TEST(GenerateTetMesh, ASphereConvergesWithTheSquareOfTheEdgeLength) {
  expectSecondOrder(test::AnalyticSphere({0.1, 0.2, 0.3}, 6), {2, 1.2, 0.75}, 2);
}

TEST(GenerateTetMesh, ATorusConvergesWithTheSquareOfTheEdgeLength) {
  expectSecondOrder(test::AnalyticTorus({0.1, 0.2, 0.3}, 6, 2.5), {1.5, 1, 0.75}, 0);
}

TEST(GenerateTetMesh, TheBoundaryNodesOfASphereLieAtItsRadius) {
  constexpr double radius = 5, edge = 1;
  const Vector3d center(4, -3, 2);
  const TetMesh mesh = generateTetMesh(test::AnalyticSphere(center, radius), withEdge(edge));
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const double r = (mesh.nodes[n] - center).norm();
    if (mesh.kinds[n] == NodeKind::Boundary) {
      ASSERT_NEAR(r, radius, kMaxBoundaryPhi * edge);
    } else {
      ASSERT_LT(r, radius);
    }
  }
}

TEST(GenerateTetMesh, ACompressorOfTheCallerGetsTheCandidate) {
  const test::AnalyticSphere ball({0.1, 0.2, 0.3}, 5);
  GenerateTetMeshOptions options = withEdge(1);
  int calls = 0;
  options.compressor = [&](TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& compression) {
    ++calls;
    EXPECT_EQ(compression.edgeLength, 1);
    return compressOntoSurface(mesh, phi, compression);
  };
  EXPECT_EQ(generateTetMesh(ball, options).nodes, generateTetMesh(ball, withEdge(1)).nodes);
  EXPECT_EQ(calls, 1);
}

TEST(GenerateTetMesh, OnlyTetsBeyondTheBoundsMakeTheCandidateGiveWay) {
  const test::AnalyticSphere ball({0.1, 0.2, 0.3}, 5);
  GenerateTetMeshOptions options = withEdge(1);
  options.compressor = [&](TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& compression) {
    CompressionReport report = compressOntoSurface(mesh, phi, compression);
    const auto& [a, b, c, d] = mesh.tets.front();  // left flat
    auto& x = mesh.nodes;
    x[a] += 0.9 * ((x[b] + x[c] + x[d]) / 3 - x[a]);
    return report;
  };
  GenerateTetMeshReport usual, loose;
  generateTetMesh(ball, options, &usual);
  options.repair = {{1e6, 0, 180}, {1e6, 0, 180}};
  generateTetMesh(ball, options, &loose);
  EXPECT_GT(usual.patchesTried, 0);
  EXPECT_EQ(loose.patchesTried, 0);
}

TEST(GenerateTetMesh, SameBitsForAnyNumberOfThreadsAndEveryRun) {
  const test::RandomShape shape = test::randomShape(8);
  const auto withThreads = [&](std::size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return generateTetMesh(shape, withEdge(2));
  };
  const TetMesh one = withThreads(1);
  EXPECT_GT(one.tets.size(), 5000u);
  for (const std::size_t count : {1, 2, 4}) {
    const TetMesh again = withThreads(count);
    EXPECT_EQ(again.nodes, one.nodes) << count;
    EXPECT_EQ(again.tets, one.tets) << count;
    EXPECT_EQ(again.kinds, one.kinds) << count;
  }
}

TEST(GenerateTetMesh, ReportsWhatItDid) {
  const test::AnalyticSphere sphere(Vector3d::Zero(), 5);
  std::vector<std::pair<std::string, double>> calls;
  GenerateTetMeshOptions options = withEdge(2);
  options.maxEdgeLength = 4;
  options.label = 7;
  options.progress = [&](std::string_view stage, double fraction) { calls.emplace_back(stage, fraction); };
  GenerateTetMeshReport report;
  report.patchesTried = 99;  // what was there is forgotten
  const TetMesh mesh = generateTetMesh(sphere, options, &report);
  EXPECT_EQ(mesh.labels, std::vector<std::int32_t>(mesh.tets.size(), 7));

  ASSERT_EQ(report.stages.size(), 3u);
  EXPECT_EQ(report.stages[0].name, "lattice");
  EXPECT_EQ(report.stages[1].name, "candidate");
  EXPECT_EQ(report.stages[2].name, "compression");
  for (const auto& stage : report.stages) EXPECT_GE(stage.seconds, 0);
  EXPECT_EQ(report.nodesReleased, 0);
  EXPECT_LE(report.patchesMended, report.patchesTried);
  EXPECT_LT(report.patchesTried, 99);
  double largestPhi = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.kinds[n] == NodeKind::Boundary)
      largestPhi = std::max(largestPhi, std::abs(sphere.value(mesh.nodes[n])));
  EXPECT_EQ(report.maxBoundaryPhi, largestPhi);
  EXPECT_GT(report.latticeNodes, static_cast<std::int64_t>(mesh.nodes.size()));

  ASSERT_GE(calls.size(), 2u);
  EXPECT_EQ(calls.front(), std::pair(std::string("lattice"), 0.0));
  EXPECT_EQ(calls.back(), std::pair(std::string("compression"), 1.0));
  EXPECT_TRUE(std::ranges::is_sorted(calls, {}, [](const auto& call) { return call.second; }));
}

TEST(GenerateTetMesh, AProgressThatThrowsStopsIt) {
  struct Stopped {};
  const test::AnalyticSphere sphere(Vector3d::Zero(), 5);
  for (const std::string last : {"lattice", "candidate", "compression"}) {
    GenerateTetMeshOptions options = withEdge(2);
    std::string reached;
    options.progress = [&](std::string_view stage, double) {
      reached = stage;
      if (stage == last) throw Stopped();
    };
    EXPECT_THROW(generateTetMesh(sphere, options), Stopped);
    EXPECT_EQ(reached, last);
  }
}

TEST(GenerateTetMesh, RefusesOptionsOutOfRange) {
  const test::AnalyticSphere sphere(Vector3d::Zero(), 2, {.band = 3});
  using Options = GenerateTetMeshOptions;
  struct Case {
    const char* what;
    void (*spoil)(Options&);
  };
  const std::vector<Case> cases{{"no edge length", [](Options& o) { o.edgeLength = 0; }},
                                {"negative edge length", [](Options& o) { o.edgeLength = -1; }},
                                {"edge length nan", [](Options& o) { o.edgeLength = kNan; }},
                                {"edge length infinite", [](Options& o) { o.edgeLength = kInfinite; }},
                                {"band below 1.55 edge lengths", [](Options& o) { o.edgeLength = 1.94; }},
                                {"largest edge below the edge", [](Options& o) { o.maxEdgeLength = 0.9; }},
                                {"largest edge negative", [](Options& o) { o.maxEdgeLength = -1; }},
                                {"largest edge nan", [](Options& o) { o.maxEdgeLength = kNan; }},
                                {"curvature negative", [](Options& o) { o.curvature = -1; }},
                                {"curvature nan", [](Options& o) { o.curvature = kNan; }},
                                {"levels negative", [](Options& o) { o.levels = -1; }}};
  for (const Case& c : cases) {
    Options options = withEdge(1);
    c.spoil(options);
    EXPECT_THROW(generateTetMesh(sphere, options), std::invalid_argument) << c.what;
  }
  Options limit = withEdge(1.5);
  limit.maxEdgeLength = 1.5;
  EXPECT_NO_THROW(generateTetMesh(sphere, limit));
}

TEST(GenerateTetMesh, AShapeBelowTheLatticeGivesAnEmptyMesh) {
  const test::AnalyticSphere speck({0.1, 0.2, 0.3}, 0.05);
  const TetMesh mesh = generateTetMesh(speck, withEdge(2));
  EXPECT_TRUE(mesh.tets.empty());
  EXPECT_TRUE(mesh.nodes.empty());
  EXPECT_TRUE(mesh.labels.empty());
  EXPECT_TRUE(mesh.kinds.empty());
}

TEST(GenerateTetMesh, LevelsAndCurvatureDecideOnTheFinestCube) {
  // |k1| + |k2| is up to 1/0.8 + 1/4.2 = 1.49 per mm, so cubes of 1 mm are too coarse where c = 1.
  const test::AnalyticTorus torus(Vector3d::Zero(), 5, 0.8, {.resolution = 0.25});
  const auto finest = [&](int levels, double curvature) {
    GenerateTetMeshOptions options = withEdge(1);
    options.levels = levels;
    options.curvature = curvature;
    GenerateTetMeshReport report;
    const TetMesh mesh = generateTetMesh(torus, options, &report);
    return std::pair(report.finestCube, mesh.tets.size());
  };
  const auto [whole, few] = finest(0, 0);
  EXPECT_EQ(whole, 1);
  EXPECT_EQ(finest(1, 1), std::pair(whole, few));
  const auto [halved, many] = finest(0, 1);
  EXPECT_EQ(halved, 0.5);
  EXPECT_GT(many, 3 * few);
}

TEST(GenerateTetMesh, ReportsTheFinestCubeUsedNotTheFinestAllowed) {
  GenerateTetMeshReport report;
  generateTetMesh(test::AnalyticSphere(Vector3d::Zero(), 5, {.resolution = 0.25}), withEdge(2), &report);
  EXPECT_EQ(report.finestCube, 2);  // a ball asks for nothing finer: 2 mm x (1/5 + 1/5) is below 1
}

TEST(GenerateTetMesh, WhereGreenTetsWouldBeTooManyTheWholeSurfaceBecomesFiner) {
  // A box with rounded edges asks for finer cubes along twelve strips only: a few per cent of a large box,
  // all around a small one.
  const auto cubeAndMean = [](double half) {
    const test::AnalyticBox box(Vector3d::Constant(-half), Vector3d::Constant(half), {.resolution = 0.5});
    GenerateTetMeshReport report;
    const TetMesh mesh = generateTetMesh(box, withEdge(1), &report);
    std::int64_t coarse = 0;
    for (const Tet& t : mesh.tets) {
      const bool onSurface =
          std::ranges::any_of(t, [&](std::int32_t n) { return mesh.kinds[n] == NodeKind::Boundary; });
      const auto& x = mesh.nodes;
      coarse += onSurface && (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]) > 0.25;
    }
    return std::pair(coarse > 0, meshQuality(mesh).meanAspectRatio);
  };
  EXPECT_TRUE(cubeAndMean(12).first);
  EXPECT_FALSE(cubeAndMean(3.3).first);
  EXPECT_LT(cubeAndMean(3.3).second, 2.1);
}

/// Bytes of the arrays of a mesh: less than making it takes.
double bytesOf(const TetMesh& mesh) {
  return static_cast<double>(mesh.nodes.size() * (sizeof(Vector3d) + sizeof(NodeKind)) +
                             mesh.tets.size() * (sizeof(Tet) + sizeof(std::int32_t)));
}

TEST(EstimateMemory, CoversTheMeshAndGrowsWithTheSurface) {
  for (const double band : {4.0, 9.0, kInfinite}) {
    const test::AnalyticSphere sphere(Vector3d::Zero(), 6, {.band = band});
    const double coarse = estimateMemory(sphere, withEdge(2)), fine = estimateMemory(sphere, withEdge(1));
    EXPECT_GT(coarse, bytesOf(generateTetMesh(sphere, withEdge(2)))) << "band " << band;
    EXPECT_GT(fine, 3 * coarse) << "band " << band;  // four times the tets on the surface
  }
}

TEST(EstimateMemory, RefusesOptionsOutOfRange) {
  const test::AnalyticSphere sphere(Vector3d::Zero(), 5);
  EXPECT_THROW(estimateMemory(sphere, {}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
