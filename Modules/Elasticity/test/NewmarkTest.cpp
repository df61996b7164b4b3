#include "sinew/Elasticity/Newmark.h"
#include "sinew/Elasticity/Springs.h"
#include "sinew/Elasticity/StrainLimits.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <stdexcept>
#include <utility>

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

constexpr double kFarthest = 10;  // mm, of a node of the bar from the origin

Vector3d angularMomentum(const MovingBar& bar) { return test::moment(bar.motion.places, bar.momentum()); }

// x' x m v' = x' x (m v* + dt/2 f(x')) = (x + dt v*) x m v* = x x (m v + dt/2 f(x)) = x x m v
TEST(Newmark, AStepWithoutDampingKeepsBothMomenta) {
  MovingBar bar;
  FiniteElements elements(bar.body, *bar.material, {});
  EdgeSprings edges(bar.body, {.damping = 0});
  AltitudeSprings altitudes(bar.body, {.springs = {.damping = 0}});
  const double dt = stableStep(bar.body, bar.body.rest, 7000);
  for (ForceModel* forces : std::initializer_list<ForceModel*>{&elements, &edges, &altitudes})
    for (int step = 0; step < 10; ++step) {
      const Vector3d linear = test::total(bar.momentum()), angular = angularMomentum(bar);
      const double scale = test::magnitude(bar.momentum());
      newmarkStep(bar.body, *forces, NodeConstraints(bar.body.nodeCount()), dt, bar.motion,
                  {.tolerance = 1e-13});
      EXPECT_LT((test::total(bar.momentum()) - linear).norm(), 1e-12 * scale);
      EXPECT_LT((angularMomentum(bar) - angular).norm(), 1e-12 * kFarthest * scale);
    }
}

/// Passes forces on, and asks of each that it has no moment about the places where it acts.
class TorqueFree final : public ForceModel {
 public:
  explicit TorqueFree(ForceModel& forces) : forces_(forces) {}
  double energy(const NodeVectors& places) const override { return forces_.energy(places); }
  void addForces(const NodeVectors& places, NodeVectors& forces) const override {
    NodeVectors added(forces.size(), Vector3d::Zero());
    forces_.addForces(places, added);
    expectNoTorque(places, added);
    forces = test::sum(forces, added);
  }
  void moveTo(const NodeVectors& places) override {
    places_ = places;
    forces_.moveTo(places);
  }
  void addDamping(const NodeVectors& velocities, NodeVectors& forces) const override {
    NodeVectors added(forces.size(), Vector3d::Zero());
    forces_.addDamping(velocities, added);
    expectNoTorque(places_, added);
    forces = test::sum(forces, added);
  }
  int evaluations() const { return evaluations_; }

 private:
  void expectNoTorque(const NodeVectors& places, const NodeVectors& forces) const {
    EXPECT_LT(test::moment(places, forces).norm(), 1e-12 * kFarthest * test::magnitude(forces));
    ++evaluations_;
  }

  ForceModel& forces_;
  NodeVectors places_;
  mutable int evaluations_ = 0;
};

// Every force and every damping force that a step evaluates.
TEST(Newmark, NoForceOfAStepHasATorque) {
  MovingBar bar;
  EdgeSprings edges(bar.body);
  AltitudeSprings altitudes(bar.body);
  const double dt = stableStep(bar.body, bar.body.rest, 7000);
  for (ForceModel* forces : std::initializer_list<ForceModel*>{&bar.forces, &edges, &altitudes}) {
    TorqueFree checked(*forces);
    for (int step = 0; step < 3; ++step)
      newmarkStep(bar.body, checked, NodeConstraints(bar.body.nodeCount()), dt, bar.motion);
    EXPECT_GT(checked.evaluations(), 3 * 5);
  }
}

// Damping and limits have no torque where they act, but the places move on by dt w, with w = v* after its limits:
//     L' - L = dt w x m v* + dt^2/2 w x D(x) (v - v*),  P' = P
// and this is all.
TEST(Newmark, DampingAndLimitsTurnABodyByTheirKnownTermOnly) {
  for (const double change : {1e3, 0.01}) {  // at most, of an altitude in a step: none is limited, or many
    MovingBar bar;
    const StrainLimits limits(bar.body, {.strain = 0.99, .change = change});
    const NodeConstraints constraints(bar.body.nodeCount());
    const double dt = stableStep(bar.body, bar.body.rest, 7000);
    bar.motion.velocities = test::randomVectors(bar.body.nodeCount(), 500, 2);
    for (int step = 0; step < 5; ++step) {
      const NodeVectors v = bar.motion.velocities;
      const Vector3d linear = test::total(bar.momentum()), angular = angularMomentum(bar);
      const double scale = test::magnitude(bar.momentum());
      Vector3d expected = Vector3d::Zero();
      bool atHalf = true;
      const auto limit = [&](const NodeVectors& places, double, NodeVectors& velocities) {
        NodeVectors half = velocities, slower(v.size()), damping(v.size(), Vector3d::Zero());
        limits.apply(constraints, places, dt, velocities);
        EXPECT_EQ(half != velocities, change < 1);
        for (std::size_t n = 0; n < v.size(); ++n) {
          slower[n] = v[n] - half[n];
          half[n] *= dt * bar.body.masses[n];
        }
        if (!std::exchange(atHalf, false)) return;
        bar.forces.addDamping(slower, damping);
        expected = test::moment(velocities, half) + dt * dt / 2 * test::moment(velocities, damping);
      };
      newmarkStep(bar.body, bar.forces, constraints, dt, bar.motion, {.tolerance = 1e-14, .limit = limit});
      EXPECT_LT((test::total(bar.momentum()) - linear).norm(), 1e-12 * scale);
      EXPECT_GT(expected.norm(), 1e-9 * kFarthest * scale);
      EXPECT_LT((angularMomentum(bar) - angular - expected).norm(), 1e-12 * kFarthest * scale);
    }
  }
}

/// Change of the angular momentum of a damped bar in one step, and in all up to a time.
struct Drift {
  double ofAStep = 0, inAll = 0;
};
Drift angularDrift(int steps) {
  MovingBar bar;
  const double dt = stableStep(bar.body, bar.body.rest, 7000, 0.04) / steps;
  const Vector3d start = angularMomentum(bar);
  Drift drift;
  for (int step = 0; step < steps; ++step) {
    newmarkStep(bar.body, bar.forces, NodeConstraints(bar.body.nodeCount()), dt, bar.motion,
                {.tolerance = 1e-13});
    drift.inAll = (angularMomentum(bar) - start).norm();
    if (step == 0) drift.ofAStep = drift.inAll;
  }
  return drift;
}

// v - v* is dt/2 times an acceleration: the known term is O(dt^3) in a step and O(dt^2) in a time.
TEST(Newmark, DampingTurnsABodyAtTheOrderOfTheScheme) {
  const Drift coarse = angularDrift(16), fine = angularDrift(32);
  EXPECT_NEAR(std::log2(coarse.ofAStep / fine.ofAStep), 3, 0.1);
  EXPECT_NEAR(std::log2(coarse.inAll / fine.inAll), 2, 0.1);
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
