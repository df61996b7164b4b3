#include "sinew/Elasticity/Newmark.h"
#include "sinew/Elasticity/Springs.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// One mass on a linear spring with damping: m x'' + c x' + k x = 0 along x. The body only carries the
/// masses.
class OneSpring final : public ForceModel {
 public:
  OneSpring(double k, double c) : k_(k), c_(c) {}
  double energy(const NodeVectors& places) const override { return k_ * places[0].x() * places[0].x() / 2; }
  void addForces(const NodeVectors& places, NodeVectors& forces) const override {
    forces[0].x() -= k_ * places[0].x();
  }
  void moveTo(const NodeVectors&) override {}
  void addDamping(const NodeVectors& velocities, NodeVectors& forces) const override {
    forces[0].x() -= c_ * velocities[0].x();
  }

 private:
  double k_, c_;
};

ElasticBody pointMass(double mass) {
  ElasticBody body;
  body.rest = {Vector3d::Zero()};
  body.masses = {mass};
  body.firstCorner = {0, 0};
  return body;
}

/// Error of x at time 1 after `steps` steps from x = 1, v = 0, against the damped cosine.
double springError(int steps) {
  const double k = 30, c = 1;
  OneSpring spring(k, c);
  Motion motion{{Vector3d::UnitX()}, {Vector3d::Zero()}};
  const ElasticBody body = pointMass(1);
  for (int step = 0; step < steps; ++step)
    newmarkStep(body, spring, NodeConstraints(1), 1. / steps, motion, {.tolerance = 1e-14});
  const double decay = c / 2, w = std::sqrt(k - decay * decay);
  return motion.places[0].x() - std::exp(-decay) * (std::cos(w) + decay / w * std::sin(w));
}

TEST(Newmark, IsOfSecondOrderOnOneSpring) {
  const double order = std::log2(springError(200) / springError(400));
  EXPECT_NEAR(order, 2, 0.1);
}

// Explicit damping would need dt < 2 m / c = 2e-6 here.
TEST(Newmark, TheStepDoesNotDependOnTheDamping) {
  const double k = 30, dt = 0.05;
  for (const double c : {0., 1., 1e3, 1e6}) {
    OneSpring spring(k, c);
    Motion motion{{Vector3d::UnitX()}, {Vector3d::Zero()}};
    const ElasticBody body = pointMass(1);
    for (int step = 0; step < 2000; ++step) newmarkStep(body, spring, NodeConstraints(1), dt, motion);
    EXPECT_LE(std::abs(motion.places[0].x()), 1.01) << c;
  }
}

struct MovingBar {
  ElasticBody body = elasticBody(test::barMesh({4, 2, 2}, 2));
  std::unique_ptr<Material> material = neoHookean(lame(30, 0.3));
  FiniteElements forces{body, *material, {.alpha = 0.01, .beta = 0.01}};
  Motion motion{test::shaken(body.rest, 0.2, 1), test::randomVectors(body.nodeCount(), 5, 2)};

  NodeVectors momentum() const {
    NodeVectors result = motion.velocities;
    for (std::size_t n = 0; n < result.size(); ++n) result[n] *= body.masses[n];
    return result;
  }
};

TEST(Newmark, KeepsLinearMomentumAndTurnsLittle) {
  MovingBar bar;
  const Vector3d before = test::total(bar.momentum());
  const double scale = test::magnitude(bar.momentum());
  const double dt = stableStep(bar.body, bar.body.rest, 7000);
  for (int step = 0; step < 20; ++step)
    newmarkStep(bar.body, bar.forces, NodeConstraints(bar.body.nodeCount()), dt, bar.motion,
                {.tolerance = 1e-13});
  EXPECT_LT((test::total(bar.momentum()) - before).norm(), 20 * 1e-12 * scale);
}

TEST(Newmark, DampingOnlyTakesEnergy) {
  MovingBar bar;
  const double dt = stableStep(bar.body, bar.body.rest, 7000, 0.2);
  const auto energy = [&] {
    return bar.forces.energy(bar.motion.places) + kineticEnergy(bar.body, bar.motion.velocities);
  };
  const double start = energy();
  double last = start;
  for (int step = 0; step < 200; ++step) {
    newmarkStep(bar.body, bar.forces, NodeConstraints(bar.body.nodeCount()), dt, bar.motion);
    EXPECT_LT(energy(), last * 1.01);  // the scheme itself is not exact
    last = energy();
  }
  EXPECT_LT(last, 0.9 * start);
}

TEST(Newmark, HeldNodesHaveTheirVelocity) {
  MovingBar bar;
  NodeConstraints constraints(bar.body.nodeCount());
  constraints.freedom[0] = NodeFreedom::Held;
  constraints.velocities[0] = {1, 2, 3};
  constraints.freedom[5] = NodeFreedom::Tangential;
  constraints.normals[5] = Vector3d::UnitZ();
  constraints.velocities[5] = {0, 0, -2};
  const Vector3d before = bar.motion.places[0];
  const double height = bar.motion.places[5].z(), dt = stableStep(bar.body, bar.body.rest, 7000);
  for (int step = 0; step < 5; ++step) newmarkStep(bar.body, bar.forces, constraints, dt, bar.motion);
  EXPECT_LT((bar.motion.places[0] - before - 5 * dt * Vector3d(1, 2, 3)).norm(), 1e-13);
  EXPECT_NEAR(bar.motion.places[5].z(), height - 2 * 5 * dt, 1e-13);
  EXPECT_EQ(bar.motion.velocities[0], Vector3d(1, 2, 3));
}

TEST(Newmark, SameBitsForAnyNumberOfThreads) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    MovingBar bar;
    for (int step = 0; step < 5; ++step)
      newmarkStep(bar.body, bar.forces, NodeConstraints(bar.body.nodeCount()), 1e-5, bar.motion);
    return bar.motion.places;
  };
  EXPECT_EQ(run(1), run(4));
}

TEST(Newmark, RefusesAStepThatIsNone) {
  MovingBar bar;
  EXPECT_THROW(newmarkStep(bar.body, bar.forces, NodeConstraints(bar.body.nodeCount()), 0, bar.motion),
               std::invalid_argument);
}

}  // namespace
}  // namespace sinew
