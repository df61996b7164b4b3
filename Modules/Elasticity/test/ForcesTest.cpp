#include "sinew/Elasticity/ElasticForces.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Bar {
  TetMesh mesh = test::barMesh({3, 2, 2}, 4);
  ElasticBody body = elasticBody(mesh);
  std::unique_ptr<Material> material = neoHookean(lame(30, 0.4));
  NodeVectors places = test::shaken(body.rest, 0.8, 1);

  NodeVectors zeros() const { return NodeVectors(body.nodeCount(), Vector3d::Zero()); }
  NodeVectors forces() const {
    NodeVectors result = zeros();
    addElasticForces(body, *material, places, result);
    return result;
  }
};

// Bars of cubes have the volume of their cubes.
TEST(ElasticBody, MassAndVolumeAddUp) {
  const Bar bar;
  double mass = 0, volume = 0;
  for (const double m : bar.body.masses) mass += m;
  for (const double v : bar.body.volumes) volume += v;
  EXPECT_NEAR(volume, 12 * 64, 1e-9);
  EXPECT_NEAR(mass, 12 * 64 * 1e-6, 1e-15);
}

TEST(ElasticBody, RefusesAnInvertedTet) {
  TetMesh mesh = test::barMesh({1, 1, 1}, 1);
  std::swap(mesh.tets[3][0], mesh.tets[3][1]);
  EXPECT_THROW(elasticBody(mesh), std::invalid_argument);
  EXPECT_THROW(elasticBody(test::barMesh({1, 1, 1}, 1), 0), std::invalid_argument);
}

TEST(ElasticBody, AnAffineMotionIsItsDeformationGradient) {
  const Bar bar;
  const Matrix3d F = Matrix3d::Identity() + test::randomMatrix(0.3, 3);
  NodeVectors places = bar.body.rest;
  for (Vector3d& place : places) place = F * place + Vector3d(1, 2, 3);
  for (std::size_t t = 0; t < bar.body.tets.size(); ++t)
    EXPECT_LT((deformationGradient(bar.body, places, t) - F).norm(), 1e-14 * 10);
  EXPECT_NEAR(leastVolumeRatio(bar.body, places), F.determinant(), 1e-13);
}

TEST(ElasticForces, AreTheDerivativeOfTheEnergy) {
  const Bar bar;
  const NodeVectors along = test::randomVectors(bar.body.nodeCount(), 1, 4);
  const auto energy = [&](double h) {
    NodeVectors places = bar.places;
    for (std::size_t n = 0; n < places.size(); ++n) places[n] += h * along[n];
    return elasticEnergy(bar.body, *bar.material, places);
  };
  constexpr double h = 1e-3;
  const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
  const double work = -test::inner(bar.forces(), along);
  EXPECT_NEAR(slope, work, 1e-8 * test::magnitude(bar.forces()));
}

TEST(ElasticForces, KeepBothMomenta) {
  const Bar bar;
  const NodeVectors forces = bar.forces();
  EXPECT_LT(test::total(forces).norm(), 1e-12 * test::magnitude(forces));
  EXPECT_LT(test::moment(bar.places, forces).norm(),
            1e-12 * test::magnitude(forces) * 14);  // mm to the far end
}

// sigma A n / 3 with the Cauchy stress of each tet and the faces as they are now.
TEST(ElasticForces, AreTheStressesOnTheFacesOfTheTets) {
  const Bar bar;
  NodeVectors expected = bar.zeros();
  for (std::size_t t = 0; t < bar.body.tets.size(); ++t) {
    const Tet& tet = bar.body.tets[t];
    const Matrix3d F = deformationGradient(bar.body, bar.places, t);
    const Matrix3d sigma = bar.material->stress(t, F) * F.transpose() / F.determinant();
    for (std::size_t i = 0; i < 4; ++i) {
      const auto at = [&](std::size_t c) {
        return bar.places[static_cast<std::size_t>(tet[static_cast<std::size_t>(kTetFaces[i][c])])];
      };
      const Vector3d areaNormal =
          (at(1) - at(0)).cross(at(2) - at(0)) / 2;  // of the face opposite to i, outward
      expected[static_cast<std::size_t>(tet[i])] += sigma * areaNormal / 3;
    }
  }
  const NodeVectors forces = bar.forces();
  for (std::size_t n = 0; n < forces.size(); ++n)
    EXPECT_LT((forces[n] - expected[n]).norm(), 1e-12 * test::magnitude(forces));
}

TEST(ElasticForces, TheirChangeIsTheirDerivativeAndSymmetric) {
  const Bar bar;
  const NodeVectors a = test::randomVectors(bar.body.nodeCount(), 1, 5),
                    b = test::randomVectors(bar.body.nodeCount(), 1, 6);
  NodeVectors ka = bar.zeros(), kb = bar.zeros();
  addElasticForceChange(bar.body, *bar.material, bar.places, a, ka);
  addElasticForceChange(bar.body, *bar.material, bar.places, b, kb);
  EXPECT_NEAR(test::inner(ka, b), test::inner(kb, a), 1e-12 * test::magnitude(ka));
  const auto force = [&](double h) {
    Bar moved;
    for (std::size_t n = 0; n < a.size(); ++n) moved.places[n] += h * a[n];
    return moved.forces();
  };
  constexpr double h = 1e-4;
  const NodeVectors up = force(h), down = force(-h), up2 = force(2 * h), down2 = force(-2 * h);
  for (std::size_t n = 0; n < a.size(); ++n) {
    const Vector3d slope = (8 * (up[n] - down[n]) - (up2[n] - down2[n])) / (12 * h);
    EXPECT_LT((slope - ka[n]).norm(), 1e-7 * test::magnitude(ka));
  }
}

TEST(DampingForces, AreSymmetricTakeEnergyAndKeepBothMomenta) {
  const Bar bar;
  DampingForces damping(bar.body, {.alpha = 2, .beta = 3});
  damping.moveTo(bar.places);
  const NodeVectors a = test::randomVectors(bar.body.nodeCount(), 1, 7),
                    b = test::randomVectors(bar.body.nodeCount(), 1, 8);
  NodeVectors da = bar.zeros(), db = bar.zeros();
  damping.add(a, da);
  damping.add(b, db);
  EXPECT_NEAR(test::inner(da, b), test::inner(db, a), 1e-12 * test::magnitude(da));
  EXPECT_LT(test::inner(da, a), 0);
  EXPECT_LT(test::total(da).norm(), 1e-12 * test::magnitude(da));
  EXPECT_LT(test::moment(bar.places, da).norm(), 1e-12 * test::magnitude(da) * 14);
}

// A motion as a rigid body has no rate of strain.
TEST(DampingForces, LeaveRigidMotionsAlone) {
  const Bar bar;
  DampingForces damping(bar.body, {.alpha = 2, .beta = 3});
  damping.moveTo(bar.places);
  NodeVectors velocities = bar.places, forces = bar.zeros();
  for (Vector3d& v : velocities) v = Vector3d(0.3, -0.2, 0.5).cross(v) + Vector3d(1, 1, 2);
  damping.add(velocities, forces);
  EXPECT_LT(test::magnitude(forces), 1e-10);
}

TEST(ElasticForces, SameBitsForAnyNumberOfThreads) {
  Bar bar;
  bar.mesh = test::barMesh({12, 12, 12}, 1);
  bar.body = elasticBody(bar.mesh);
  bar.places = test::shaken(bar.body.rest, 0.2, 1);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    NodeVectors forces = bar.forces();
    forces.emplace_back(elasticEnergy(bar.body, *bar.material, bar.places), 0, 0);
    return forces;
  };
  EXPECT_EQ(run(1), run(4));
}

}  // namespace
}  // namespace sinew
