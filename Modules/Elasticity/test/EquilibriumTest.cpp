#include "sinew/Elasticity/Equilibrium.h"
#include "sinew/Elasticity/Muscle.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool onBox(const Vector3d& place, const Vector3d& size) {
  return (place.array() < 1e-9).any() || ((size - place).array() < 1e-9).any();
}

// With its boundary in an affine motion, a homogeneous body follows it everywhere.
TEST(Equilibrium, PatchTest) {
  const Matrix3d F = Matrix3d::Identity() + test::randomMatrix(0.1, 3);
  for (const auto& material :
       {stVenantKirchhoff(lame(30, 0.3)), neoHookean(lame(30, 0.3)), corotated(lame(30, 0.3))}) {
    TetMesh mesh = test::barMesh({3, 3, 3}, 1);
    const NodeVectors shifts = test::randomVectors(mesh.nodes.size(), 0.15, 2);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      if (!onBox(mesh.nodes[n], {3, 3, 3})) mesh.nodes[n] += shifts[n];
    const ElasticBody body = elasticBody(mesh);
    NodeConstraints constraints(body.nodeCount());
    NodeVectors places = body.rest;
    for (std::size_t n = 0; n < body.nodeCount(); ++n) {
      places[n] = F * body.rest[n];
      if (onBox(body.rest[n], {3, 3, 3}))
        constraints.freedom[n] = NodeFreedom::Held;
      else
        places[n] += Vector3d(0.05, -0.03, 0.04);
    }
    const EquilibriumReport report =
        findEquilibrium(body, *material, constraints, {}, places, {.tolerance = 1e-12});
    EXPECT_TRUE(report.converged) << report.residual;
    for (std::size_t n = 0; n < body.nodeCount(); ++n)
      EXPECT_LT((places[n] - F * body.rest[n]).norm(), 1e-10);
  }
}

/// Tip deflection of a cantilever of length 16, depth 1 and height 4 under a shear load at its end, over that
/// of Timoshenko's beam.
double cantilever(int across) {
  const double length = 16, depth = 1, height = 4, young = 100, force = 0.005;
  const ElasticBody body = elasticBody(test::barMesh({4 * across, across / 4, across}, height / across));
  NodeConstraints constraints(body.nodeCount());
  NodeVectors load(body.nodeCount(), Vector3d::Zero()), places = body.rest;
  std::vector<std::size_t> tip;
  for (std::size_t n = 0; n < body.nodeCount(); ++n) {
    if (body.rest[n].x() < 1e-9) constraints.freedom[n] = NodeFreedom::Held;
    if (body.rest[n].x() > length - 1e-9) tip.push_back(n);
  }
  for (const std::size_t n : tip) load[n].z() = force / static_cast<double>(tip.size());
  const auto material = corotated(lame(young, 0));
  EXPECT_TRUE(findEquilibrium(body, *material, constraints, load, places, {.tolerance = 1e-5}).converged);
  double deflection = 0;
  for (const std::size_t n : tip)
    deflection += (places[n] - body.rest[n]).z() / static_cast<double>(tip.size());
  const double inertia = depth * std::pow(height, 3) / 12, shear = young / 2, area = depth * height;
  const double beam =
      force * std::pow(length, 3) / (3 * young * inertia) + force * length / (5. / 6 * shear * area);
  return deflection / beam;
}

// Linear tets are too stiff in bending by O(h^2).
TEST(Equilibrium, ACantileverConvergesToTheBeam) {
  const double coarse = 1 - cantilever(4), middle = 1 - cantilever(8), fine = 1 - cantilever(16);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.35);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.2);
  EXPECT_LT(std::abs(fine), 0.02);
}

/// A bar along z, whose sides are free, pulled to a stretch; the mean axial force on its end.
double endForce(const Material& material, const ElasticBody& body, double stretch) {
  NodeConstraints constraints(body.nodeCount());
  NodeVectors places = body.rest;
  double length = 0;
  for (const Vector3d& place : body.rest) length = std::max(length, place.z());
  for (std::size_t n = 0; n < body.nodeCount(); ++n) {
    places[n].z() *= stretch;
    places[n].head<2>() /= std::sqrt(stretch);
    if (body.rest[n].z() < 1e-9 || body.rest[n].z() > length - 1e-9) {
      constraints.freedom[n] = NodeFreedom::Tangential;  // slides across, as in a uniaxial test
      constraints.normals[n] = Vector3d::UnitZ();
    }
  }
  const EquilibriumReport report =
      findEquilibrium(body, material, constraints, {}, places, {.tolerance = 1e-9});
  EXPECT_TRUE(report.converged) << stretch << " " << report.residual;
  NodeVectors forces(body.nodeCount(), Vector3d::Zero());
  addElasticForces(body, material, places, forces);
  double sum = 0;
  for (std::size_t n = 0; n < body.nodeCount(); ++n)
    if (body.rest[n].z() > length - 1e-9) sum -= forces[n].z();
  return sum;
}

/// P_zz of the law where the sides are free of stress: the root of P_xx over the width.
double uniaxialStress(const Material& material, double stretch) {
  double low = 0.3, high = 2;
  const auto stress = [&](double width) {
    return material.stress(0, Vector3d(width, width, stretch).asDiagonal());
  };
  for (int bisection = 0; bisection < 100; ++bisection) {
    const double width = (low + high) / 2;
    (stress(width)(0, 0) > 0 ? high : low) = width;
  }
  return stress(low)(2, 2);
}

TEST(Equilibrium, AMuscleIsInTheUniaxialStateOfItsMaterial) {
  const ElasticBody body = elasticBody(test::barMesh({2, 2, 6}, 1));
  Muscle muscle(std::vector<MuscleFibre>(body.tets.size()));
  for (const double activation : {0., 0.5, 1.})
    for (const double stretch : {0.9, 1., 1.1, 1.3}) {
      muscle.activate(activation);
      const double expected = 4 * uniaxialStress(muscle, stretch);  // mm^2
      EXPECT_NEAR(endForce(muscle, body, stretch), expected, 0.01 * std::abs(expected) + 1e-6)
          << activation << " " << stretch;
    }
}

/// Zajac's curves over the optimal length as Blemker et al. 2005 give them, of full activation, written out once
/// more.
double forceLength(double activation, double stretch) {
  const double slope = 0.05 * 6.6 * std::exp(6.6 * 0.4), toe = 0.05 * (std::exp(6.6 * 0.4) - 1);
  const double passive = stretch <= 1    ? 0
                         : stretch < 1.4 ? 0.05 * (std::exp(6.6 * (stretch - 1)) - 1)
                                         : toe + slope * (stretch - 1.4);
  const double active = stretch <= 0.6   ? 9 * std::pow(stretch - 0.4, 2)
                        : stretch >= 1.4 ? 9 * std::pow(stretch - 1.6, 2)
                                         : 1 - 4 * std::pow(1 - stretch, 2);
  return passive + activation * active;
}

/// The force on the end of a bar of muscle over its area, against the law in one dimension: tension of the fibres
/// and what a matrix that keeps its volume carries, mu (s - 1/s^2). Where the law is zero, nothing is compared.
void expectForceLengthLaw(const MuscleOptions& options, double activation,
                          const std::vector<double>& stretches) {
  const ElasticBody body = elasticBody(test::barMesh({2, 2, 4}, 1));
  Muscle muscle(std::vector<MuscleFibre>(body.tets.size()), options);
  muscle.activate(activation);
  for (const double stretch : stretches) {
    const double fibres = options.tension * forceLength(activation, stretch);
    const double law = fibres + options.shear * (stretch - 1 / (stretch * stretch));
    if (fibres == 0) continue;
    EXPECT_NEAR(endForce(muscle, body, stretch) / 4 / law, 1, 0.01) << activation << " " << stretch;
    if (options.shear < 0.1) {
      EXPECT_NEAR(law / fibres, 1, 0.005);
    }
  }
}

// A soft matrix leaves the force to the fibres. Where their tension falls with the stretch, at full activation from 1
// to 1.3, nothing then keeps one cross-section as long as the next: there is no uniaxial state to compare with.
TEST(Equilibrium, AMuscleOfASoftMatrixFollowsTheForceLengthLawOfItsFibres) {
  const MuscleOptions soft{.shear = 0.05, .bulk = 500};
  for (const double activation : {0., 0.1, 0.5})
    expectForceLengthLaw(soft, activation, {0.7, 0.9, 1, 1.1, 1.2, 1.3, 1.45});
  expectForceLengthLaw(soft, 1, {0.6, 0.7, 0.8, 0.9, 1, 1.3, 1.45});
}

// The matrix of every muscle, with the bulk modulus that the law stands for, at all stretches.
TEST(Equilibrium, AMuscleFollowsTheForceLengthLawOfFibresAndMatrix) {
  const MuscleOptions incompressible{.bulk = 50000};
  for (const double activation : {0., 0.1, 0.5, 1.})
    expectForceLengthLaw(incompressible, activation, {0.5, 0.7, 0.9, 1, 1.1, 1.2, 1.3, 1.45});
}

TEST(Equilibrium, NoTetIsInvertedOnTheWay) {
  const ElasticBody body = elasticBody(test::barMesh({2, 2, 4}, 1));
  NodeConstraints constraints(body.nodeCount());
  NodeVectors places = body.rest;
  for (std::size_t n = 0; n < body.nodeCount(); ++n) {
    places[n].z() *= 0.4;
    if (body.rest[n].z() < 1e-9 || body.rest[n].z() > 4 - 1e-9) constraints.freedom[n] = NodeFreedom::Held;
  }
  const auto material = neoHookean(lame(30, 0.45));
  const EquilibriumReport report = findEquilibrium(body, *material, constraints, {}, places);
  EXPECT_TRUE(report.converged) << report.residual;
  EXPECT_GT(report.leastVolumeRatio, 0);
  EXPECT_GT(places[body.nodeCount() / 2].array().abs().maxCoeff(), 0);
}

// Moved as a whole, a body has forces of rounding only: no balance of them is better than another.
TEST(Equilibrium, ForcesBelowTheLeastCountAsNone) {
  const ElasticBody body = elasticBody(test::barMesh({1, 1, 3}, 1));
  NodeConstraints constraints(body.nodeCount());
  constraints.freedom[0] = NodeFreedom::Held;
  NodeVectors places = body.rest;
  for (Vector3d& place : places)
    place = Eigen::AngleAxisd(0.7, Vector3d::UnitX()) * place + Vector3d(1e3, 0, 0);
  const auto material = neoHookean(lame(30, 0.45));
  const EquilibriumReport report =
      findEquilibrium(body, *material, constraints, {}, places, {.tolerance = 1e-4, .leastForce = 1e-3});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.steps, 0);
  EXPECT_EQ(report.largestForce, 1e-3);
}

TEST(Equilibrium, RefusesAnInvertedStart) {
  const ElasticBody body = elasticBody(test::barMesh({1, 1, 1}, 1));
  NodeVectors places = body.rest;
  places[0] = {2, 2, 2};
  const auto material = neoHookean(lame(30, 0.3));
  EXPECT_THROW(findEquilibrium(body, *material, NodeConstraints(body.nodeCount()), {}, places),
               std::invalid_argument);
}

}  // namespace
}  // namespace sinew
