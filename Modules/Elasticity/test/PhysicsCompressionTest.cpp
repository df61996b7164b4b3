#include "sinew/Elasticity/CompressionMethod.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/TestSupport/RandomShapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Method = CompressionMethod;

struct Shape {
  const char* name;
  const SignedDistance& phi;
  double edge;
};

/// Round, ringed, elongated, thin, and with sharp edges.
template <class Function>
void forEachShape(const Function& f) {
  const test::AnalyticSphere ball({0.1, 0.2, 0.3}, 5);
  const test::AnalyticTorus torus({0.1, 0.2, 0.3}, 5, 2);
  const test::AnalyticCapsule capsule({-4, 0.1, 0.2}, {4, 0.3, -0.2}, 1.7);
  const test::AnalyticBox plate({-5, -4, -0.6}, {5, 4, 0.6});
  const test::AnalyticBox box({-3.1, -2.7, -2.3}, {3.1, 2.7, 2.3});
  for (const Shape& shape : std::initializer_list<Shape>{{"ball", ball, 1},
                                                         {"torus", torus, 1},
                                                         {"capsule", capsule, 1},
                                                         {"plate", plate, 1},
                                                         {"box", box, 1}}) {
    SCOPED_TRACE(shape.name);
    f(shape);
  }
}

struct Meshed {
  TetMesh mesh;
  CompressionMethodReport method;
  GenerateTetMeshReport generation;
};

Meshed meshBy(Method method, const SignedDistance& phi, double edge,
              const PhysicsCompressionOptions& physics = {}) {
  Meshed run;
  GenerateTetMeshOptions options;
  options.edgeLength = edge;
  compressBy(method, physics, options, &run.method);
  run.mesh = generateTetMesh(phi, options, &run.generation);
  return run;
}

double maxPhi(const TetMesh& mesh, const SignedDistance& phi) {
  double largest = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.kinds[n] == NodeKind::Boundary) largest = std::max(largest, std::abs(phi.value(mesh.nodes[n])));
  return largest;
}

class ByPhysics : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, ByPhysics, testing::Values(Method::Springs, Method::FiniteElements),
                         [](const auto& test) {
                           return test.param == Method::Springs ? "Springs" : "FiniteElements";
                         });

// The bounds of the product: on every shape better than the best mesh of Teran et al. 2005, section 7.
TEST_P(ByPhysics, MeshesKeepTheBounds) {
  forEachShape([&](const Shape& shape) {
    const Meshed run = meshBy(GetParam(), shape.phi, shape.edge);
    const MeshQuality quality = meshQuality(run.mesh);
    ASSERT_GT(quality.tets, 0);
    EXPECT_LE(quality.maxAspectRatio, kPhysicsBounds.aspectRatio);
    EXPECT_GE(quality.minDihedralDeg, kPhysicsBounds.minDihedralDeg);
    EXPECT_LE(quality.maxDihedralDeg, kPhysicsBounds.maxDihedralDeg);
    EXPECT_TRUE(meshConditions(run.mesh).good());
    EXPECT_LT(maxPhi(run.mesh, shape.phi), 1e-3 * shape.edge);
  });
}

// On a smooth shape physics does it alone: what optimization mends is the exception.
TEST_P(ByPhysics, ASmoothShapeNeedsNearlyNoMending) {
  const Meshed run = meshBy(GetParam(), test::AnalyticSphere({0.1, 0.2, 0.3}, 5), 1);
  EXPECT_TRUE(run.method.physics.converged);
  EXPECT_LT(run.method.physics.maxPhi, kNearSurface);
  EXPECT_LT(run.method.physics.kineticEnergy, PhysicsCompressionOptions{}.stillness);
  EXPECT_EQ(run.method.physics.leftBehind, 0);
  EXPECT_LE(run.method.mendedNodes, std::ssize(run.mesh.nodes) / 10);
  EXPECT_EQ(run.generation.patchesTried, 0);
}

TEST_P(ByPhysics, ForcesBringTheBoundaryNearAndVelocitiesOntoTheSurface) {
  const test::AnalyticSphere ball({0.1, 0.2, 0.3}, 5);
  PhysicsCompressionOptions physics;
  physics.forceSteps = 40;
  const Meshed run = meshBy(GetParam(), ball, 1, physics);
  EXPECT_EQ(run.method.physics.forceSteps, 40);
  // The body pushes back: a boundary node, at most 0.75 edges off at the start, stays off.
  EXPECT_LT(run.method.physics.maxPhiAfterForces, 0.7);
  EXPECT_GT(run.method.physics.maxPhiAfterForces, 0.1);
  EXPECT_LT(run.method.physics.maxPhi, kNearSurface);
  EXPECT_GT(run.method.physics.velocitySteps, 0);
}

TEST_P(ByPhysics, AStrongerPushBringsTheBoundaryNearer) {
  const test::AnalyticSphere ball({0.1, 0.2, 0.3}, 5);
  const auto after = [&](double push) {
    PhysicsCompressionOptions physics;
    physics.forceSteps = 40;
    physics.push = push;
    return meshBy(GetParam(), ball, 1, physics).method.physics.maxPhiAfterForces;
  };
  EXPECT_LT(after(2), after(0.5));
}

TEST_P(ByPhysics, SameBitsForAnyNumberOfThreads) {
  const test::AnalyticBox box({-3.1, -2.7, -2.3}, {3.1, 2.7, 2.3});
  const auto withThreads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return meshBy(GetParam(), box, 1).mesh.nodes;
  };
  EXPECT_EQ(withThreads(1), withThreads(4));
}

TEST(PhysicsCompression, EveryMaterialKeepsTheBounds) {
  const test::AnalyticTorus torus({0.1, 0.2, 0.3}, 5, 2);
  for (const MeshingMaterial material :
       {MeshingMaterial::NeoHookean, MeshingMaterial::StVenantKirchhoff, MeshingMaterial::Corotated}) {
    PhysicsCompressionOptions physics;
    physics.material = material;
    const Meshed run = meshBy(Method::FiniteElements, torus, 1, physics);
    const MeshQuality quality = meshQuality(run.mesh);
    EXPECT_LE(quality.maxAspectRatio, kPhysicsBounds.aspectRatio);
    EXPECT_GE(quality.minDihedralDeg, kPhysicsBounds.minDihedralDeg);
    EXPECT_LE(quality.maxDihedralDeg, kPhysicsBounds.maxDihedralDeg);
  }
}

// With fewer springs the result is the same; where forces jump as springs begin and cease to act, damping is needed.
TEST(PhysicsCompression, FewerSpringsGiveTheSameQuality) {
  const test::AnalyticSphere ball({0.1, 0.2, 0.3}, 4);
  TetMesh candidate;
  CompressionOptions compression;
  GenerateTetMeshOptions options;
  options.edgeLength = 1;
  options.compressor = [&](TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& given) {
    candidate = mesh;
    compression = given;
    return compressOntoSurface(mesh, phi, given);
  };
  generateTetMesh(ball, options);
  const ElasticBody body = elasticBody(candidate);
  const auto compressed = [&](const PhysicsCompressionOptions& physics) {
    struct {
      double aspectRatio;
      std::size_t springs;
      PhysicsCompressionReport report;
    } result{};
    TetMesh mesh = candidate;
    result.report = compressByPhysics(mesh, ball, compression, physics);
    result.aspectRatio = meshQuality(mesh).maxAspectRatio;
    result.springs =
        AltitudeSprings(body, {.shortestOnly = physics.shortestOnly, .actsBelow = physics.actsBelow})
            .actingSprings(mesh.nodes);
    return result;
  };
  const auto all = compressed({.forces = MeshingForces::Springs});
  EXPECT_EQ(all.springs, 4 * candidate.tets.size());
  using Options = PhysicsCompressionOptions;
  for (const Options& physics :
       {Options{.forces = MeshingForces::Springs, .shortestOnly = true, .damping = 0.1},
        Options{.forces = MeshingForces::Springs, .actsBelow = 1},
        Options{.forces = MeshingForces::Springs, .actsBelow = 0.95, .damping = 0.1}}) {
    const auto fewer = compressed(physics);
    EXPECT_TRUE(fewer.report.converged);
    EXPECT_NEAR(fewer.aspectRatio / all.aspectRatio, 1, 0.05);
    EXPECT_LT(fewer.springs, all.springs);
  }
  const auto undamped = compressed({.forces = MeshingForces::Springs, .shortestOnly = true});
  EXPECT_FALSE(undamped.report.converged);
  EXPECT_NEAR(undamped.aspectRatio / all.aspectRatio, 1, 0.05);
}

// What is deep inside is where the lattice put it.
TEST(PhysicsCompression, MovesOnlyWhatIsNearTheBoundary) {
  const test::AnalyticSphere ball({0.1, 0.2, 0.3}, 8);
  GenerateTetMeshOptions options;
  options.edgeLength = 1;
  TetMesh before;
  options.compressor = [&](TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& compression) {
    before = mesh;
    compressByPhysics(mesh, phi, compression);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      const double moved = (mesh.nodes[n] - before.nodes[n]).norm();
      if (phi.value(before.nodes[n]) < -4 * compression.edgeLength) {
        EXPECT_EQ(moved, 0);
      }
    }
    return compressOntoSurface(mesh, phi, compression);
  };
  generateTetMesh(ball, options);
  EXPECT_FALSE(before.tets.empty());
}

// Hybrid ends where optimization does: within 10 % of its quality.
TEST(PhysicsCompression, HybridIsAsGoodAsOptimization) {
  forEachShape([](const Shape& shape) {
    const MeshQuality hybrid = meshQuality(meshBy(Method::Hybrid, shape.phi, shape.edge).mesh);
    const MeshQuality optimized = meshQuality(meshBy(Method::Optimization, shape.phi, shape.edge).mesh);
    EXPECT_LE(hybrid.maxAspectRatio, 1.1 * optimized.maxAspectRatio);
    EXPECT_LE(hybrid.meanAspectRatio, 1.1 * optimized.meanAspectRatio);
    EXPECT_GE(hybrid.minDihedralDeg, 0.9 * optimized.minDihedralDeg);
    EXPECT_LE(hybrid.maxDihedralDeg, 1.1 * optimized.maxDihedralDeg);
  });
}

/// Of the compression of a ball, s: the better of two runs.
double compressionSeconds(Method method) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  double least = 1e300;
  for (int run = 0; run < 2; ++run) {
    GenerateTetMeshOptions options;
    options.edgeLength = 0.6;
    compressBy(method, {}, options);
    const Compressor inner = options.compressor ? options.compressor
                                                : [](TetMesh& mesh, const SignedDistance& phi,
                                                     const CompressionOptions& compression) {
                                                    return compressOntoSurface(mesh, phi, compression);
                                                  };
    options.compressor = [&](TetMesh& mesh, const SignedDistance& phi,
                             const CompressionOptions& compression) {
      const std::clock_t start = std::clock();
      CompressionReport report = inner(mesh, phi, compression);
      least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      return report;
    };
    generateTetMesh(test::AnalyticSphere({0.1, 0.2, 0.3}, 5), options);
  }
  return least;
}

// The bound of the product; 4.4 times were measured. Sanitizers slow the two down by different factors.
TEST(PhysicsCompression, TakesAtMostTenTimesTheTimeOfOptimization) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "no times under sanitizers";
#endif
  EXPECT_LE(compressionSeconds(Method::FiniteElements), 10 * compressionSeconds(Method::Optimization));
}

TEST(PhysicsCompression, RefusesOptionsOutOfRange) {
  const auto refused = [](const PhysicsCompressionOptions& physics) {
    GenerateTetMeshOptions options;
    EXPECT_THROW(compressBy(Method::FiniteElements, physics, options), std::invalid_argument);
  };
  refused({.poisson = 0.5});
  refused({.damping = -1});
  refused({.push = 0});
  refused({.velocitySteps = 0});
  refused({.limits = {.strain = 1}});
}

}  // namespace
}  // namespace sinew
