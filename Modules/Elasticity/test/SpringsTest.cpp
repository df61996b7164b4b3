#include "sinew/Elasticity/Altitude.h"
#include "sinew/Elasticity/Newmark.h"
#include "sinew/Elasticity/Springs.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TetMesh oneTet() {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {3, 0.2, 0}, {0.5, 2.5, 0}, {0.7, 0.9, 2}};
  mesh.tets = {{0, 1, 2, 3}};
  return mesh;
}

NodeVectors zeros(const ElasticBody& body) { return NodeVectors(body.nodeCount(), Vector3d::Zero()); }

NodeVectors forcesOf(const ForceModel& springs, const ElasticBody& body, const NodeVectors& places) {
  NodeVectors forces = zeros(body);
  springs.addForces(places, forces);
  return forces;
}

TEST(Altitude, IsThreeVolumesOverTheFace) {
  const TetMesh mesh = oneTet();
  const auto& x = mesh.nodes;
  const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
  for (int corner = 0; corner < 4; ++corner) {
    const auto& face = kTetFaces[static_cast<std::size_t>(corner)];
    const auto at = [&](std::size_t c) { return x[static_cast<std::size_t>(face[c])]; };
    const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    const Altitude found = altitude(x, mesh.tets[0], corner);
    EXPECT_NEAR(found.height, 3 * volume / area, 1e-14);
    EXPECT_NEAR(found.weights.sum(), 0, 1e-15);
    Vector3d fromFoot = Vector3d::Zero();  // the node minus its foot
    for (int i = 0; i < 4; ++i) fromFoot += found.weights[i] * x[static_cast<std::size_t>(i)];
    EXPECT_LT((fromFoot - found.height * found.normal).norm(), 1e-14);
  }
}

TEST(Altitude, IsNegativeWhenInverted) {
  TetMesh mesh = oneTet();
  mesh.nodes[3].z() = -1;
  EXPECT_NEAR(altitude(mesh.nodes, mesh.tets[0], 3).height, -1, 1e-15);
}

struct Kind {
  const char* name;
  std::function<std::unique_ptr<ForceModel>(const ElasticBody&)> make;
};
std::vector<Kind> kinds() {
  return {{"edges", [](const ElasticBody& body) { return std::make_unique<EdgeSprings>(body); }},
          {"altitudes", [](const ElasticBody& body) { return std::make_unique<AltitudeSprings>(body); }}};
}

TEST(Springs, PullNothingAtRest) {
  const ElasticBody body = elasticBody(test::barMesh({2, 2, 2}, 3));
  for (const Kind& kind : kinds())
    EXPECT_LT(test::magnitude(forcesOf(*kind.make(body), body, body.rest)), 1e-9) << kind.name;
}

TEST(Springs, ForcesAreTheDerivativeOfTheEnergyAndKeepBothMomenta) {
  const ElasticBody body = elasticBody(test::barMesh({2, 2, 2}, 3));
  const NodeVectors places = test::shaken(body.rest, 0.6, 1),
                    along = test::randomVectors(body.nodeCount(), 1, 2);
  for (const Kind& kind : kinds()) {
    const auto springs = kind.make(body);
    const NodeVectors forces = forcesOf(*springs, body, places);
    const auto energy = [&](double h) {
      NodeVectors moved = places;
      for (std::size_t n = 0; n < moved.size(); ++n) moved[n] += h * along[n];
      return springs->energy(moved);
    };
    constexpr double h = 1e-3;
    const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
    EXPECT_NEAR(slope, -test::inner(forces, along), 1e-8 * test::magnitude(forces)) << kind.name;
    EXPECT_LT(test::total(forces).norm(), 1e-12 * test::magnitude(forces)) << kind.name;
    EXPECT_LT(test::moment(places, forces).norm(), 1e-12 * test::magnitude(forces) * 10) << kind.name;
  }
}

TEST(Springs, DampingIsSymmetricTakesEnergyAndKeepsBothMomenta) {
  const ElasticBody body = elasticBody(oneTet());
  const NodeVectors places = test::shaken(body.rest, 0.4, 3);
  for (const Kind& kind : kinds()) {
    const auto springs = kind.make(body);
    springs->moveTo(places);
    Eigen::Matrix<double, 12, 12> D;
    for (int c = 0; c < 12; ++c) {
      NodeVectors unit = zeros(body), column = zeros(body);
      unit[static_cast<std::size_t>(c / 3)][c % 3] = 1;
      springs->addDamping(unit, column);
      for (int r = 0; r < 12; ++r) D(r, c) = column[static_cast<std::size_t>(r / 3)][r % 3];
      EXPECT_LT(test::total(column).norm(), 1e-12 * test::magnitude(column)) << kind.name;
      EXPECT_LT(test::moment(places, column).norm(), 1e-11 * test::magnitude(column)) << kind.name;
    }
    EXPECT_LT((D - D.transpose()).norm(), 1e-14 * D.norm()) << kind.name;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>> eigen(D);
    EXPECT_LE(eigen.eigenvalues().maxCoeff(), 1e-12 * D.norm()) << kind.name;
    EXPECT_LT(eigen.eigenvalues().minCoeff(), -0.1 * D.norm()) << kind.name;
  }
}

// Teran et al. 2005, the stress that altitude springs are.
TEST(AltitudeSprings, StressHasTheSameNodalForces) {
  const ElasticBody body = elasticBody(oneTet());
  const AltitudeSprings springs(body);
  const NodeVectors places = test::shaken(body.rest, 0.3, 4), forces = forcesOf(springs, body, places);
  const Matrix3d sigma = springs.stress(places, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = [&](std::size_t c) { return places[static_cast<std::size_t>(kTetFaces[i][c])]; };
    const Vector3d areaNormal = (at(1) - at(0)).cross(at(2) - at(0)) / 2;
    EXPECT_LT((sigma * areaNormal / 3 - forces[i]).norm(), 1e-12 * test::magnitude(forces));
  }
}

TEST(AltitudeSprings, OptionsChooseWhichAct) {
  const ElasticBody body = elasticBody(oneTet());
  NodeVectors flat = body.rest;
  flat[3].z() = 0.2;
  EXPECT_EQ(AltitudeSprings(body).actingSprings(flat), 4u);
  EXPECT_EQ(AltitudeSprings(body, {.shortestOnly = true}).actingSprings(flat), 1u);
  EXPECT_EQ(AltitudeSprings(body, {.actsBelow = 0.9}).actingSprings(body.rest), 0u);
}

/// Height of node 3 after the tet was left to itself with node 3 pushed through the plane of the others,
/// which are held.
double heightAfterRelease(ForceModel& springs, const ElasticBody& body) {
  NodeConstraints constraints(body.nodeCount());
  for (std::size_t n = 0; n < 3; ++n) constraints.freedom[n] = NodeFreedom::Held;
  Motion motion{body.rest, zeros(body)};
  motion.places[3].z() = -1;
  const double dt = stableStep(body, body.rest, SpringOptions().soundSpeed, 0.2);
  for (int step = 0; step < 2000; ++step) newmarkStep(body, springs, constraints, dt, motion);
  return altitude(motion.places, body.tets[0], 3).height;
}

// Edges have the same length on both sides of a plane; signed heights have not.
TEST(AltitudeSprings, BringAnInvertedTetBackWhereEdgesDoNot) {
  const ElasticBody body = elasticBody(oneTet());
  EdgeSprings edges(body);
  AltitudeSprings altitudes(body);
  EXPECT_NEAR(heightAfterRelease(edges, body), -2, 0.05);
  EXPECT_NEAR(heightAfterRelease(altitudes, body), 2, 0.05);
}

constexpr double kLength = 16, kSpeed = 1000;  // mm, mm/s

/// Time for a push at one end of a bar to arrive at the other, as the time when half of the step has come
/// through.
double arrival(double cube) {
  const double length = kLength, width = 2;
  const int along = static_cast<int>(std::lround(length / cube)),
            across = static_cast<int>(std::lround(width / cube));
  const ElasticBody body = elasticBody(test::barMesh({along, across, across}, cube));
  EdgeSprings springs(body, {.soundSpeed = kSpeed, .damping = 0.2});
  NodeConstraints constraints(body.nodeCount());
  const double speed = 10;
  for (std::size_t n = 0; n < body.nodeCount(); ++n)
    if (body.rest[n].x() < 1e-9) {
      constraints.freedom[n] = NodeFreedom::Tangential;
      constraints.normals[n] = Vector3d::UnitX();
      constraints.velocities[n] = speed * Vector3d::UnitX();
    }
  Motion motion{body.rest, zeros(body)};
  const double dt = stableStep(body, body.rest, kSpeed, 0.25);
  const auto farEnd = [&] {
    double sum = 0;
    int count = 0;
    for (std::size_t n = 0; n < body.nodeCount(); ++n)
      if (std::abs(body.rest[n].x() - length) < 1e-9) sum += motion.velocities[n].x(), ++count;
    return sum / count;
  };
  while (farEnd() < speed && motion.time < 1)
    newmarkStep(body, springs, constraints, dt, motion);  // 2 speed in the end
  return motion.time;
}

// k ~ m / l0 makes the speed of waves a property of the material, not of the mesh.
TEST(EdgeSprings, WavesHaveTheSpeedOfSoundOnAMeshAndOnOneTwiceAsFine) {
  const double coarse = arrival(1), fine = arrival(0.5);
  EXPECT_NEAR(kLength / coarse / kSpeed, 1, 0.05);
  EXPECT_NEAR(kLength / fine / kSpeed, 1, 0.05);
  EXPECT_NEAR(fine / coarse, 1, 0.05);
}

TEST(Springs, RefuseOptionsOutOfRange) {
  const ElasticBody body = elasticBody(oneTet());
  EXPECT_THROW(EdgeSprings(body, {.soundSpeed = 0}), std::invalid_argument);
  EXPECT_THROW(EdgeSprings(body, {.damping = -1}), std::invalid_argument);
  EXPECT_THROW(AltitudeSprings(body, {.actsBelow = 0}), std::invalid_argument);
}

// k = m / T^2: with the same masses, a displacement has the same forces whatever the size of the mesh.
TEST(Springs, ACrossingTimeGivesTheSameRatesInLargeAndSmallTets) {
  TetMesh small = oneTet(), large = oneTet();
  for (Vector3d& node : large.nodes) node *= 4;
  const ElasticBody bodies[]{elasticBody(small, 1e-6), elasticBody(large, 1e-6 / 64)};
  NodeVectors forces[2][2];
  for (std::size_t k = 0; k < 2; ++k) {
    const SpringOptions options{.crossingTime = 0.5};
    NodeVectors places = bodies[k].rest;
    for (std::size_t n = 0; n < places.size(); ++n)
      places[n] += 1e-3 * Vector3d(std::sin(double(n)), std::cos(double(n)), 0.3 * double(n));
    forces[0][k] = forcesOf(EdgeSprings(bodies[k], options), bodies[k], places);
    forces[1][k] = forcesOf(AltitudeSprings(bodies[k], {options}), bodies[k], places);
  }
  for (const auto& [ofSmall, ofLarge] : forces)
    for (std::size_t n = 0; n < ofSmall.size(); ++n) {
      EXPECT_GT(ofSmall[n].norm(), 0);
      // The displacement turns the springs by 1e-3 of their length at most.
      EXPECT_LT((ofSmall[n] - ofLarge[n]).norm(), 1e-2 * ofSmall[n].norm());
    }
}

}  // namespace
}  // namespace sinew
