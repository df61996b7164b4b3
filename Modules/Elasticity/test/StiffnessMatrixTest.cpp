#include "StiffnessMatrix.h"
#include "sinew/Elasticity/ElasticForces.h"
#include "sinew/Elasticity/Muscle.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

// Two ways to the same sum of a few dozen terms: round-off.
TEST(StiffnessMatrix, ItsProductIsTheChangeOfTheForces) {
  const ElasticBody body = elasticBody(test::barMesh({2, 3, 4}, 1));
  const NodeVectors places = test::shaken(body.rest, 0.1, 1),
                    steps = test::randomVectors(body.nodeCount(), 1, 2);
  Muscle muscle(std::vector<MuscleFibre>(body.tets.size()));
  muscle.activate(0.7);
  StiffnessMatrix matrix(body);
  matrix.assemble(muscle, places);
  NodeVectors product(body.nodeCount()), change(body.nodeCount(), Eigen::Vector3d::Zero());
  matrix.multiply(steps, product);
  addElasticForceChange(body, muscle, places, steps, change);
  const double scale = test::magnitude(change);
  for (std::size_t n = 0; n < body.nodeCount(); ++n)
    EXPECT_LT((product[n] + change[n]).norm(), 1e-14 * scale);
}

TEST(StiffnessMatrix, HasTheBlocksOfNodesThatShareATet) {
  const ElasticBody body = elasticBody(test::barMesh({1, 1, 1}, 1));
  StiffnessMatrix matrix(body);
  matrix.assemble(*neoHookean(lame(30, 0.3)), body.rest);
  std::size_t blocks = 0;
  for (std::size_t n = 0; n < matrix.rows(); ++n) {
    std::size_t last = 0;
    matrix.forEachBlock(n, [&](std::size_t column, const Eigen::Matrix3d& block) {
      EXPECT_TRUE(column > last || column == 0);
      last = column;
      ++blocks;
      EXPECT_TRUE(column != n || block == matrix.diagonal(n));
    });
  }
  EXPECT_EQ(blocks, 8 + 2 * (12 + 6 + 1));  // nodes, and edges: of the cube, of its faces, through its middle
}

}  // namespace
}  // namespace sinew
