#include "ConjugateGradients.h"
#include "TwoLevelPreconditioner.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// The linear system of a bar along z that is held at z = 0 and slides on a wall along x.
struct HeldBar {
  ElasticBody body;
  NodeConstraints constraints;
  StiffnessMatrix matrix;
  TwoLevelPreconditioner preconditioner;

  explicit HeldBar(int length)
      : body(elasticBody(test::barMesh({3, 3, length}, 1))),
        constraints(held(body)),
        matrix(body),
        preconditioner(body, matrix, constraints) {
    matrix.assemble(*neoHookean(lame(30, 0.45)), body.rest);
    preconditioner.update();
  }

  static NodeConstraints held(const ElasticBody& body) {
    NodeConstraints constraints(body.nodeCount());
    for (std::size_t n = 0; n < body.nodeCount(); ++n) {
      if (body.rest[n].x() < 1e-9) {
        constraints.freedom[n] = NodeFreedom::Tangential;
        constraints.normals[n] = Vector3d::UnitX();
      }
      if (body.rest[n].z() < 1e-9) constraints.freedom[n] = NodeFreedom::Held;
    }
    return constraints;
  }

  NodeVectors free(NodeVectors vectors) const {
    for (std::size_t n = 0; n < vectors.size(); ++n) vectors[n] = constraints.free(n, vectors[n]);
    return vectors;
  }

  /// Steps of conjugate gradients to 1e-6 under a load at the tip.
  template <class Precondition>
  int steps(const Precondition& precondition) const {
    NodeVectors load(body.nodeCount(), Vector3d::Zero()), x = load;
    load.back() = {1, 2, 3};
    const auto apply = [&](const NodeVectors& in, NodeVectors& out) { matrix.multiply(in, out); };
    const CgResult result = conjugateGradients(constraints, apply, precondition, load, x,
                                               {.tolerance = 1e-6, .iterations = 5000});
    EXPECT_TRUE(result.converged);
    return result.iterations;
  }
};

TEST(TwoLevelPreconditioner, IsSymmetricAndPositive) {
  const HeldBar bar(12);
  const std::size_t nodes = bar.body.nodeCount();
  for (unsigned seed = 1; seed < 5; ++seed) {
    const NodeVectors a = bar.free(test::randomVectors(nodes, 1, seed)),
                      b = bar.free(test::randomVectors(nodes, 1, seed + 10));
    NodeVectors Ma(nodes), Mb(nodes);
    bar.preconditioner.apply(a, Ma);
    bar.preconditioner.apply(b, Mb);
    EXPECT_NEAR(test::inner(Ma, b), test::inner(a, Mb), 1e-12 * std::abs(test::inner(a, Ma)));  // round-off
    EXPECT_GT(test::inner(a, Ma), 0);
    EXPECT_EQ(bar.free(Ma), Ma);
  }
}

// A wave of error crosses one layer of nodes per step where only neighbours are known, and thus needs steps by
// the length; patches of a fixed number of nodes need as many steps for any length, but for the ends.
TEST(TwoLevelPreconditioner, StepsDoNotGrowWithTheBody) {
  const auto both = [](int length) {
    const HeldBar bar(length);
    const auto blocks = [&](const NodeVectors& in, NodeVectors& out) {
      for (std::size_t n = 0; n < in.size(); ++n)
        out[n] = bar.constraints.free(n, bar.matrix.diagonal(n).inverse() * in[n]);
    };
    const auto twoLevels = [&](const NodeVectors& in, NodeVectors& out) {
      bar.preconditioner.apply(in, out);
    };
    return std::pair(bar.steps(blocks), bar.steps(twoLevels));
  };
  const auto [shortBlocks, shortPatches] = both(15);
  const auto [longBlocks, longPatches] = both(60);
  EXPECT_GT(longBlocks, 2 * shortBlocks);
  EXPECT_LT(longPatches, 1.3 * shortPatches);
  EXPECT_LT(longPatches, longBlocks / 5);
}

}  // namespace
}  // namespace sinew
