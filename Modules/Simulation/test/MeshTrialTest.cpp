#include "sinew/Simulation/MeshTrial.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// The first and last `cubes` layers of nodes of a bar along z.
Attachments endsOfBar(const TetMesh& mesh, double thickness = 0) {
  double length = 0;
  for (const Vector3d& node : mesh.nodes) length = std::max(length, node.z());
  Attachments ends;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (mesh.nodes[n].z() < thickness + 1e-9) ends.origin.push_back(static_cast<std::int32_t>(n));
    if (mesh.nodes[n].z() > length - thickness - 1e-9) ends.insertion.push_back(static_cast<std::int32_t>(n));
  }
  return ends;
}

/// Held at its ends, its fibres along z.
TrialSetup setupOfBar(const TetMesh& mesh) {
  return {.attachments = endsOfBar(mesh), .fibres = NodeVectors(mesh.tets.size(), Vector3d::UnitZ())};
}

/// The trial, and the places of its nodes at every frame.
struct Recorded {
  TrialReport report;
  std::vector<NodeVectors> places;

  Recorded(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options) {
    report = runTrial(mesh, setup, options,
                      [&](const TrialFrame&, const NodeVectors& now) { places.push_back(now); });
  }
};

double largestDistance(const NodeVectors& a, const NodeVectors& b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, (a[n] - b[n]).norm());
  return largest;
}

/// P_zz of a law where the sides are free of stress, and the stretch across.
struct Uniaxial {
  double stress, across;

  Uniaxial(const Material& material, std::size_t tet, double stretch) {
    double low = 0.3, high = 2;
    const auto stressAt = [&](double width) {
      return material.stress(tet, Vector3d(width, width, stretch).asDiagonal());
    };
    for (int bisection = 0; bisection < 60; ++bisection) {
      const double width = (low + high) / 2;
      (stressAt(width)(0, 0) > 0 ? high : low) = width;
    }
    across = low;
    stress = stressAt(low)(2, 2);
  }
};

/// And a bar apart from it.
TetMesh withAnotherBar(TetMesh mesh, const Eigen::Vector3i& cubes) {
  const auto first = static_cast<std::int32_t>(mesh.nodes.size());
  const TetMesh other = test::barMesh(cubes, 1);
  for (const Vector3d& node : other.nodes) mesh.nodes.push_back(node + Vector3d(9, 0, 0));
  for (const Tet& tet : other.tets)
    mesh.tets.push_back({tet[0] + first, tet[1] + first, tet[2] + first, tet[3] + first});
  return mesh;
}

TEST(MeshTrial, StartsAtRestAndHasItsFramesEvenlyInTime) {
  const TetMesh mesh = test::barMesh({1, 1, 3}, 1);
  const Recorded trial(mesh, setupOfBar(mesh), {.duration = 3, .frames = 6});
  ASSERT_EQ(trial.report.frames.size(), 7);
  EXPECT_EQ(trial.places.size(), 7);
  EXPECT_EQ(trial.places.front(), mesh.nodes);
  EXPECT_NEAR(trial.report.frames.front().volume, 3, 1e-12);  // round-off
  for (int k = 0; k <= 6; ++k) {
    const TrialFrame& frame = trial.report.frames[static_cast<std::size_t>(k)];
    EXPECT_EQ(frame.time, 0.5 * k);
    EXPECT_NEAR(frame.amount, 1 - std::abs(k - 3) / 3., 1e-15);  // round-off
    EXPECT_TRUE(frame.converged);
  }
}

// Straight fibres at their optimal length are in balance as they are, and pull with the tension of the law.
TEST(MeshTrial, AStraightMusclePullsWithItsTension) {
  const TetMesh mesh = test::barMesh({2, 2, 6}, 1);
  const Recorded trial(mesh, setupOfBar(mesh), {.frames = 10});
  EXPECT_TRUE(trial.report.completed);
  for (const TrialFrame& frame : trial.report.frames)
    EXPECT_NEAR(frame.force, 4 * MuscleOptions().tension * frame.amount, 1e-9);  // mm^2; round-off
  EXPECT_LT(largestDistance(trial.places[5], mesh.nodes), 1e-12);
}

// A muscle in series with a tendon shortens as far as it stretches the tendon: where both have the tension of their
// one-dimensional laws. Held ends and the step between both are felt over about a width, of 28.
TEST(MeshTrial, AMuscleInSeriesWithATendonFollowsTheForceLengthLaw) {
  const TetMesh mesh = test::barMesh({2, 2, 56}, 1);
  TrialSetup setup = setupOfBar(mesh);
  for (const Tet& tet : mesh.tets) {
    double z = 0;
    for (const std::int32_t n : tet) z += mesh.nodes[static_cast<std::size_t>(n)].z() / 4;
    setup.tendons.push_back(z < 28 ? 0 : 1);
  }
  MuscleOptions options;
  options.tendonTension = 300;  // soft, so that the muscle shortens much
  const Recorded trial(mesh, setup, {.frames = 4, .muscle = options});
  ASSERT_TRUE(trial.report.completed) << trial.report.verdict;
  Muscle law({{}, {.tendon = 1}}, options);
  for (int k = 1; k <= 2; ++k) {
    law.activate(0.5 * k);
    double low = 0.5, high = 1;  // stretch of the muscle
    for (int bisection = 0; bisection < 50; ++bisection) {
      const double s = (low + high) / 2;
      (Uniaxial(law, 0, s).stress < Uniaxial(law, 1, 2 - s).stress ? low : high) = s;
    }
    EXPECT_LT(low, 1 - 0.08 * k);
    EXPECT_NEAR(trial.report.frames[static_cast<std::size_t>(k)].force / (4 * Uniaxial(law, 0, low).stress),
                1, 0.02)
        << "activation " << 0.5 * k;
  }
}

TEST(MeshTrial, ASpindleContractsFullyAndReturnsToRest) {
  const TetMesh mesh = test::spindleMesh({3, 3, 9}, 1);
  const Recorded trial(mesh, setupOfBar(mesh), {.frames = 20});
  EXPECT_TRUE(trial.report.completed) << trial.report.verdict;
  EXPECT_GT(trial.report.leastVolumeRatio, 0.5);
  EXPECT_GT(trial.report.growth, 0.1);
  // What the tolerance leaves of the deformation, 1 mm: 1e-4 of a force bends it by less than 1e-3.
  EXPECT_GT(largestDistance(trial.places[10], mesh.nodes), 0.3);
  EXPECT_LT(largestDistance(trial.places[20], mesh.nodes), 1e-3);
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_LT(largestDistance(trial.places[k], trial.places[20 - k]), 1e-3);
  EXPECT_EQ(trial.report.verdict.find("contraction completes: worst aspect ratio "), 0)
      << trial.report.verdict;
}

// Between its ends, by two widths and more, a slender bar is in the homogeneous uniaxial state: the force follows
// from the stretch there, and so does the width.
TEST(MeshTrial, AStretchedBarIsInTheUniaxialState) {
  const TetMesh mesh = test::barMesh({2, 2, 32}, 1);
  const Recorded trial(mesh, setupOfBar(mesh),
                       {.trial = Trial::Stretch, .amount = 0.5, .frames = 10, .tolerance = 1e-8});
  ASSERT_TRUE(trial.report.completed);
  const SoftTissue tissue;
  const auto law = neoHookean({.mu = tissue.shear, .lambda = tissue.bulk - 2. / 3 * tissue.shear});
  for (std::size_t k = 1; k <= 5; ++k) {
    const auto node = [&](int i, int j, int z) {
      return trial.places[k][static_cast<std::size_t>(i + 3 * (j + 3 * z))];
    };
    const double stretch = (node(1, 1, 20) - node(1, 1, 12)).norm() / 8;
    const Uniaxial expected(*law, 0, stretch);
    EXPECT_GT(stretch, 1 + 0.1 * static_cast<double>(k));  // the ends are stiffer
    EXPECT_NEAR((node(2, 1, 16) - node(0, 1, 16)).norm() / 2, expected.across, 1e-3);
    EXPECT_NEAR(trial.report.frames[k].force / (4 * expected.stress), 1, 2e-3);
  }
}

// Of a circular bar under small twist the volume does not change; the square one warps, and linear tets add
// strains of O(h^2 twist^2).
TEST(MeshTrial, ATwistKeepsTheVolume) {
  const TetMesh mesh = test::barMesh({3, 3, 12}, 1);
  const Recorded trial(mesh, setupOfBar(mesh), {.trial = Trial::Twist, .frames = 8});
  ASSERT_TRUE(trial.report.completed);
  EXPECT_EQ(trial.report.frames[4].amount, 90);
  for (const TrialFrame& frame : trial.report.frames)
    EXPECT_NEAR(frame.volume / 108, 1, 0.005) << frame.amount;
  // A quarter turn takes x to y at the far end.
  const std::size_t corner = mesh.nodes.size() - 1;
  EXPECT_LT((trial.places[4][corner] - Vector3d(0, 3, 12)).norm(), 1e-12);
  EXPECT_LT((trial.places[4][3] - mesh.nodes[3]).norm(), 1e-12);
}

// Whatever moves the body does the work that it stores: the integral of the force along its way, here of the
// trapezoids between ten frames, of an almost linear force.
TEST(MeshTrial, TheForceDoesTheWork) {
  const TetMesh mesh = test::barMesh({3, 2, 6}, 1);
  struct Row {
    Trial trial;
    double wayOfOne;  // of amount, mm or rad
  };
  for (const auto& [trial, wayOfOne] : {Row{Trial::Compress, 6}, Row{Trial::Stretch, 6},
                                        Row{Trial::Indent, 2}, Row{Trial::Twist, std::numbers::pi / 180}}) {
    const Recorded done(mesh, setupOfBar(mesh), {.trial = trial, .frames = 20, .tolerance = 1e-6});
    ASSERT_TRUE(done.report.completed) << done.report.verdict;
    double work = 0;
    for (std::size_t k = 1; k <= 10; ++k) {
      const TrialFrame &before = done.report.frames[k - 1], &now = done.report.frames[k];
      work += wayOfOne * (now.amount - before.amount) * (now.force + before.force) / 2;
    }
    EXPECT_NEAR(work / done.report.frames[10].energy, 1, 0.01) << trialName(trial);
  }
}

TEST(MeshTrial, AnIndenterGoesAsDeepAsItShould) {
  const TetMesh mesh = test::barMesh({6, 4, 8}, 1);
  const Recorded trial(mesh, setupOfBar(mesh), {.trial = Trial::Indent, .frames = 6});
  ASSERT_TRUE(trial.report.completed) << trial.report.verdict;
  double deepest = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const double depth = std::abs((trial.places[3][n] - mesh.nodes[n]).y());  // the thinnest way
    deepest = std::max(deepest, depth);
  }
  EXPECT_NEAR(deepest, 0.3 * 4, 0.3 * 4 * 1e-2);  // bulging aside of the patch is no deeper
  EXPECT_GT(trial.report.frames[3].force, 0);
  EXPECT_LT(trial.report.leastVolumeRatio, 0.9);
}

TEST(MeshTrial, WhatCannotBeIsReported) {
  const TetMesh mesh = test::barMesh({3, 3, 3}, 1);
  const Recorded trial(mesh, setupOfBar(mesh), {.trial = Trial::Compress, .amount = 0.99, .halvings = 1});
  const TrialReport& report = trial.report;
  EXPECT_FALSE(report.completed);
  ASSERT_TRUE(report.stoppedAt.has_value());
  EXPECT_GT(*report.stoppedAt, 0.3);
  EXPECT_LT(*report.stoppedAt, 0.99);
  EXPECT_GE(*report.stoppedAt, report.frames.back().amount);
  EXPECT_GT(report.leastVolumeRatio, 0);
  EXPECT_EQ(report.verdict.find("compression stops at "), 0) << report.verdict;
  EXPECT_NE(report.verdict.find("tet "), std::string::npos) << report.verdict;
}

TEST(MeshTrial, SameBitsForAnyNumberOfThreads) {
  const TetMesh mesh = test::spindleMesh({6, 6, 10}, 1);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return Recorded(mesh, setupOfBar(mesh), {.frames = 2, .tolerance = 1e-2});
  };
  const Recorded one = run(1), four = run(4);
  EXPECT_EQ(one.places, four.places);
  EXPECT_EQ(one.report.verdict, four.report.verdict);
  for (std::size_t k = 0; k < one.report.frames.size(); ++k)
    EXPECT_EQ(one.report.frames[k].energy, four.report.frames[k].energy);
}

// Turned and shifted, the mesh must do the same; what differs is rounding, under the tolerance of the balance.
TEST(MeshTrial, DoesNotKnowWhereTheMeshIs) {
  const TetMesh mesh = test::spindleMesh({2, 2, 6}, 1);
  const Eigen::AngleAxisd turn(1, Vector3d(1, 2, 3).normalized());
  TetMesh turned = mesh;
  for (Vector3d& node : turned.nodes) node = turn * node + Vector3d(10, -20, 5);
  TrialSetup setup = setupOfBar(mesh), turnedSetup = setup;
  for (Vector3d& fibre : turnedSetup.fibres) fibre = turn * fibre;
  for (const Trial trial : {Trial::Contract, Trial::Compress, Trial::Twist}) {
    const TrialOptions options{.trial = trial, .frames = 4, .tolerance = 1e-8};
    const Recorded a(mesh, setup, options), b(turned, turnedSetup, options);
    ASSERT_TRUE(a.report.completed && b.report.completed);
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        EXPECT_LT((turn * a.places[k][n] + Vector3d(10, -20, 5) - b.places[k][n]).norm(), 1e-6);
  }
}

/// What runTrial says against a set-up.
std::string refusal(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options = {}) {
  try {
    runTrial(mesh, setup, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

TEST(MeshTrial, RefusesMeshesThatCannotBeHeld) {
  const TetMesh mesh = test::barMesh({1, 1, 3}, 1);
  const TrialSetup good = setupOfBar(mesh);
  const auto with = [&](auto change) {
    TrialSetup setup = good;
    change(setup);
    return refusal(mesh, setup);
  };
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(with([](TrialSetup& s) { s.attachments.origin.clear(); }), "there is no node at the origin");
  says(with([](TrialSetup& s) { s.attachments.insertion.push_back(99); }),
       "the insertion has node 99, the mesh 16");
  says(with([](TrialSetup& s) { s.attachments.insertion.push_back(0); }),
       "node 0 is at the origin and at the insertion");
  says(with([](TrialSetup& s) { s.attachments.insertion.push_back(4); }), "the ends touch: tet ");
  says(with([](TrialSetup& s) { s.fibres.pop_back(); }), "there are 17 fibres for 18 tets");
  says(with([](TrialSetup& s) { s.fibres[3] *= 2; }), "the fibre of tet 3 near (");
  says(with([](TrialSetup& s) { s.tendons = {0}; }), "there are 1 shares of tendon for 18 tets");
  says(with([](TrialSetup& s) { s.tendons = std::vector<double>(18, 1.5); }),
       "the share of tendon of tet 0 near (");

  TetMesh inverted = mesh;
  std::swap(inverted.tets[4][0], inverted.tets[4][1]);
  inverted.tets[7][0] = inverted.tets[7][1];
  says(refusal(inverted, good), "2 tets are flat or inverted at rest, the first is tet 4 near (");
  says(refusal({}, good), "the mesh has no tets");

  const TetMesh pieces = withAnotherBar(mesh, {1, 1, 4});
  TrialSetup forPieces = good;
  forPieces.fibres.assign(pieces.tets.size(), Vector3d::UnitZ());
  says(refusal(pieces, forPieces), "nothing holds 24 of the 42 tets, the first near (9.");
  forPieces.attachments.insertion = {20};  // of the other bar
  says(refusal(pieces, forPieces), "no piece of the mesh reaches from the origin to the insertion");
}

TEST(MeshTrial, TinyAmountsFindTheirBalance) {
  const TetMesh mesh = test::spindleMesh({2, 2, 6}, 1);
  for (const Trial trial : kTrials)
    for (const double share : {1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
      const TrialOptions options{.trial = trial, .amount = share * usualAmount(trial), .frames = 2};
      EXPECT_TRUE(runTrial(mesh, setupOfBar(mesh), options).completed) << trialName(trial) << ' ' << share;
    }
}

TEST(MeshTrial, AStepCanEndATrial) {
  const TetMesh mesh = test::spindleMesh({2, 2, 6}, 1);
  int steps = 0, frames = 0;
  const TrialOptions options{.trial = Trial::Twist, .frames = 2, .onStep = [&] {
                               if (++steps == 2) throw std::runtime_error("stop");
                             }};
  EXPECT_THROW(
      runTrial(mesh, setupOfBar(mesh), options, [&](const TrialFrame&, const NodeVectors&) { ++frames; }),
      std::runtime_error);
  EXPECT_EQ(frames, 1) << "within the way to the second";
}

TEST(MeshTrial, SmallPiecesThatNothingHoldsStandStill) {
  const TetMesh mesh = test::spindleMesh({2, 2, 6}, 1), pieces = withAnotherBar(mesh, {1, 1, 1});
  for (const Trial trial : kTrials) {
    TrialSetup setup = setupOfBar(mesh);
    setup.fibres.assign(pieces.tets.size(), Vector3d::UnitZ());
    const Recorded done(pieces, setup, {.trial = trial, .frames = 2});
    EXPECT_TRUE(done.report.completed) << done.report.verdict;
    EXPECT_EQ(done.report.loosePieces, trial == Trial::Indent ? 0 : 1)
        << trialName(trial);  // else in the bed
    if (trial == Trial::Indent) continue;
    EXPECT_EQ(done.report.looseTets, 6);
    EXPECT_NE(done.report.verdict.find("; 6 tets in 1 piece that nothing holds stood still"),
              std::string::npos);
    for (std::size_t n = mesh.nodes.size(); n < pieces.nodes.size(); ++n)
      EXPECT_EQ(done.places[1][n], pieces.nodes[n]);
    EXPECT_TRUE(std::isfinite(done.report.frames[1].force));
  }
}

TEST(MeshTrial, RefusesOptionsOutOfRange) {
  const TetMesh mesh = test::barMesh({1, 1, 3}, 1);
  const TrialSetup setup = setupOfBar(mesh);
  for (const TrialOptions& options :
       {TrialOptions{.amount = 1.1}, TrialOptions{.amount = 0}, TrialOptions{.duration = 0},
        TrialOptions{.frames = 3}, TrialOptions{.frames = 0}, TrialOptions{.tolerance = 0},
        TrialOptions{.halvings = -1}, TrialOptions{.muscle = {.bulk = -1}},
        TrialOptions{.trial = Trial::Compress, .amount = 1},
        TrialOptions{.trial = Trial::Stretch, .amount = -0.1},
        TrialOptions{.trial = Trial::Twist, .amount = 0},
        TrialOptions{.trial = Trial::Twist, .tissue = {.bulk = 1}},
        TrialOptions{.trial = Trial::Twist, .axis = Vector3d::Zero()},
        TrialOptions{.trial = Trial::Indent, .push = Vector3d::UnitZ()}})
    EXPECT_NE(refusal(mesh, setup, options), "nothing");
}

}  // namespace
}  // namespace sinew
