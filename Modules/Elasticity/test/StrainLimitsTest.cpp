#include "sinew/Elasticity/Altitude.h"
#include "sinew/Elasticity/StrainLimits.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

struct Squeezed {
  ElasticBody body = elasticBody(test::barMesh({3, 3, 3}, 1));
  NodeVectors velocities = test::randomVectors(body.nodeCount(), 100, 1);
  double dt = 0.01;

  NodeVectors momenta() const {
    NodeVectors result = velocities;
    for (std::size_t n = 0; n < result.size(); ++n) result[n] *= body.masses[n];
    return result;
  }
};

TEST(StrainLimits, KeepBothMomenta) {
  Squeezed bar;
  const NodeVectors before = bar.momenta();
  StrainLimits(bar.body).apply(NodeConstraints(bar.body.nodeCount()), bar.body.rest, bar.dt, bar.velocities);
  const NodeVectors after = bar.momenta();
  EXPECT_GT(
      (test::total(before) - test::total(after)).norm() + test::magnitude(before) - test::magnitude(after),
      0.1 * test::magnitude(before));
  EXPECT_LT((test::total(before) - test::total(after)).norm(), 1e-12 * test::magnitude(before));
  EXPECT_LT((test::moment(bar.body.rest, before) - test::moment(bar.body.rest, after)).norm(),
            1e-12 * test::magnitude(before) * 5);
}

// With enough sweeps every altitude is within its bounds after the step, and no tet is inverted.
TEST(StrainLimits, TheStepThenKeepsTheBounds) {
  Squeezed bar;
  const StrainLimitOptions options{.strain = 0.5, .change = 0.3, .sweeps = 400};
  StrainLimits(bar.body, options)
      .apply(NodeConstraints(bar.body.nodeCount()), bar.body.rest, bar.dt, bar.velocities);
  double least = 1e300;
  for (const Tet& tet : bar.body.tets)
    for (int corner = 0; corner < 4; ++corner) {
      const Altitude now = altitude(bar.body.rest, tet, corner);
      const double change = bar.dt * now.rate(bar.velocities, tet) / now.height;
      EXPECT_LT(std::abs(change), options.change + 1e-3);
      least = std::min(least, change);
    }
  EXPECT_LT(least, -0.2);  // there was something to hold
}

TEST(StrainLimits, LeaveAQuietMotionAlone) {
  Squeezed bar;
  bar.velocities = test::randomVectors(bar.body.nodeCount(), 1e-3, 1);
  const NodeVectors before = bar.velocities;
  EXPECT_EQ(StrainLimits(bar.body).apply(NodeConstraints(bar.body.nodeCount()), bar.body.rest, bar.dt,
                                         bar.velocities),
            0u);
  EXPECT_EQ(bar.velocities, before);
}

TEST(StrainLimits, HeldNodesKeepTheirVelocity) {
  Squeezed bar;
  NodeConstraints constraints(bar.body.nodeCount());
  constraints.freedom[3] = NodeFreedom::Held;
  const Vector3d before = bar.velocities[3];
  StrainLimits(bar.body).apply(constraints, bar.body.rest, bar.dt, bar.velocities);
  EXPECT_EQ(bar.velocities[3], before);
}

TEST(StrainLimits, SameBitsForAnyNumberOfThreads) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Squeezed bar;
    bar.body = elasticBody(test::barMesh({12, 12, 12}, 1));
    bar.velocities = test::randomVectors(bar.body.nodeCount(), 100, 1);
    StrainLimits(bar.body).apply(NodeConstraints(bar.body.nodeCount()), bar.body.rest, bar.dt,
                                 bar.velocities);
    return bar.velocities;
  };
  EXPECT_EQ(run(1), run(4));
}

TEST(StrainLimits, RefuseOptionsOutOfRange) {
  const Squeezed bar;
  EXPECT_THROW(StrainLimits(bar.body, {.strain = 1}), std::invalid_argument);
  EXPECT_THROW(StrainLimits(bar.body, {.change = 0}), std::invalid_argument);
  EXPECT_THROW(StrainLimits(bar.body, {.sweeps = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
