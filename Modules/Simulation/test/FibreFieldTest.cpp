#include "sinew/Simulation/FibreField.h"
#include "sinew/TestSupport/ElasticBars.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

// Inside of an attachment the harmonic field is constant and says nothing.
TEST(FibreField, ReachesIntoTheAttachments) {
  const TetMesh mesh = test::barMesh({2, 2, 12}, 1);
  for (const Vector3d& fibre : fibreField(mesh, endsOf(mesh, 0.3)))
    EXPECT_LT((fibre + Vector3d::UnitZ()).norm(), 1e-7);  // down, from origin to insertion
}

TEST(FibreField, RunsFromTendonToTendonAndIsContinuous) {
  // A bar whose middle is twice as thick, as a muscle's belly.
  TetMesh mesh = test::barMesh({6, 6, 24}, 1);
  for (Vector3d& x : mesh.nodes) {
    const double belly = 0.5 + 0.5 * std::sin(x.z() / 24 * 3.14159);
    x.head<2>() = belly * (x.head<2>() - Eigen::Vector2d(3, 3));
  }
  const NodeVectors fibres = fibreField(mesh, endsOf(mesh, 0.1));
  for (std::size_t t = 0; t < fibres.size(); ++t) {
    EXPECT_NEAR(fibres[t].norm(), 1, 1e-12);
    EXPECT_LT(fibres[t].z(), -0.8);  // the side leans by atan(3 * 0.5 * pi / 24) = 11 degrees
  }
  // The six tets of a cube are neighbours: their fibres differ by what the shape turns over a cube.
  for (std::size_t t = 0; t < fibres.size(); t += 6)
    for (std::size_t k = 1; k < 6; ++k) EXPECT_GT(fibres[t].dot(fibres[t + k]), std::cos(0.3));
}

TEST(FibreField, FillsFromTheNearestLayer) {
  const TetMesh mesh = test::barMesh({1, 1, 5}, 1);
  NodeVectors fibres(mesh.tets.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < 6; ++t) fibres[t] = {0, 3, 0};
  for (const Vector3d& fibre : filledFibres(mesh, fibres)) EXPECT_EQ(fibre, Vector3d::UnitY());
}

TEST(FibreField, WhatNothingReachesStaysZero) {
  TetMesh mesh = test::barMesh({1, 1, 1}, 1);
  const TetMesh far = mesh;
  for (const Vector3d& x : far.nodes) mesh.nodes.push_back(x + Vector3d(9, 0, 0));
  for (Tet tet : far.tets) {
    for (std::int32_t& node : tet) node += 8;
    mesh.tets.push_back(tet);
  }
  NodeVectors fibres(12, Vector3d::Zero());
  fibres[3] = Vector3d::UnitX();
  const NodeVectors filled = filledFibres(mesh, fibres);
  for (std::size_t t = 0; t < 12; ++t) EXPECT_EQ(filled[t].isZero(), t >= 6) << t;
}

TEST(FibreField, RefusesWhatIsNoFibre) {
  const TetMesh mesh = test::barMesh({1, 1, 1}, 1);
  const auto refusal = [&](const NodeVectors& fibres) {
    return test::messageOf<std::invalid_argument>([&] { filledFibres(mesh, fibres); });
  };
  EXPECT_EQ(refusal(NodeVectors(5)), "5 fibres for 6 tets");
  NodeVectors fibres(6, Vector3d::UnitX());
  fibres[2].y() = std::nan("");
  EXPECT_EQ(refusal(fibres), "the fibre of tet 2 is no vector of finite numbers");
}

}  // namespace
}  // namespace sinew
