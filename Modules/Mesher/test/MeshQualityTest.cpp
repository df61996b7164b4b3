#include "sinew/Mesher/MeshQuality.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

// Exact values are met up to the rounding of a few dozen operations; acos keeps that away from 0 and 180
// degrees.
constexpr double kExact = 1e-12;
constexpr double kDegreeRounding = 1e-11;

double degrees(double radians) { return radians * 180 / M_PI; }

constexpr std::vector<RankedTet> MeshQuality::*kRankings[]{
    &MeshQuality::largestAspectRatios, &MeshQuality::smallestDihedrals, &MeshQuality::largestDihedrals};

TEST(TetQuality, RegularTet) {
  const TetQuality q = tetQuality({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1});
  EXPECT_NEAR(q.aspectRatio, std::sqrt(1.5), kExact);
  EXPECT_NEAR(q.minDihedralDeg, degrees(std::acos(1.0 / 3)), kDegreeRounding);
  EXPECT_NEAR(q.maxDihedralDeg, degrees(std::acos(1.0 / 3)), kDegreeRounding);
  EXPECT_NEAR(std::abs(q.volume), 8.0 / 3, kExact);
}

TEST(TetQuality, BccTet) {
  const TetQuality q = tetQuality({0, 0, 0}, {1, 0, 0}, {.5, .5, .5}, {.5, -.5, .5});
  EXPECT_NEAR(q.aspectRatio, std::sqrt(2.0), kExact);
  EXPECT_NEAR(q.minDihedralDeg, 60, kDegreeRounding);
  EXPECT_NEAR(q.maxDihedralDeg, 90, kDegreeRounding);
}

TEST(TetQuality, CornerOfACube) {
  // Longest edge sqrt 2, shortest altitude 1 / sqrt 3; the slanted face meets the others at acos(1 / sqrt 3).
  const TetQuality q = tetQuality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_NEAR(q.aspectRatio, std::sqrt(6.0), kExact);
  EXPECT_NEAR(q.minDihedralDeg, degrees(std::acos(1 / std::sqrt(3.0))), kDegreeRounding);
  EXPECT_NEAR(q.maxDihedralDeg, 90, kDegreeRounding);
  EXPECT_NEAR(q.volume, 1.0 / 6, kExact);
}

TEST(TetQuality, SwappingTwoNodesTurnsOnlyTheSignOfTheVolume) {
  const Vector3d a(0, 0, 0), b(2, 0.1, 0), c(0.3, 1, 0), d(0.2, 0.4, 0.9);
  const TetQuality q = tetQuality(a, b, c, d), swapped = tetQuality(b, a, c, d);
  EXPECT_GT(q.volume, 0);
  EXPECT_NEAR(swapped.volume, -q.volume, kExact);
  EXPECT_NEAR(swapped.aspectRatio, q.aspectRatio, kExact);
  EXPECT_NEAR(swapped.minDihedralDeg, q.minDihedralDeg, kDegreeRounding);
  EXPECT_NEAR(swapped.maxDihedralDeg, q.maxDihedralDeg, kDegreeRounding);
}

TEST(TetQuality, DoesNotDependOnSizeAndPlace) {
  std::mt19937 random(3);
  const auto coordinate = [&] { return double(random()) / 4294967296.0; };
  for (int i = 0; i < 100; ++i) {
    std::array<Vector3d, 4> x;
    for (Vector3d& p : x) p = {coordinate(), coordinate(), coordinate()};
    const Eigen::Affine3d move = Eigen::Translation3d(1, -2, 3) *
                                 Eigen::AngleAxisd(coordinate(), Vector3d(1, 2, 3).normalized()) *
                                 Eigen::Scaling(16.0);
    const TetQuality q = tetQuality(x[0], x[1], x[2], x[3]);
    const TetQuality moved = tetQuality(move * x[0], move * x[1], move * x[2], move * x[3]);
    if (q.aspectRatio > 100) continue;  // its altitude is mostly rounding
    EXPECT_NEAR(moved.aspectRatio, q.aspectRatio, 1e-9 * q.aspectRatio);
    EXPECT_NEAR(moved.minDihedralDeg, q.minDihedralDeg, 1e-8);
    EXPECT_NEAR(moved.maxDihedralDeg, q.maxDihedralDeg, 1e-8);
    EXPECT_NEAR(moved.volume, q.volume * 4096, 1e-9 * 4096);
  }
}

TEST(TetQuality, FlatTetsHaveInfiniteAspectRatio) {
  const TetQuality sliver = tetQuality({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  EXPECT_TRUE(std::isinf(sliver.aspectRatio));
  EXPECT_NEAR(sliver.minDihedralDeg, 0, kDegreeRounding);
  EXPECT_NEAR(sliver.maxDihedralDeg, 180, kDegreeRounding);
  const TetQuality point = tetQuality({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  EXPECT_TRUE(std::isinf(point.aspectRatio));
  EXPECT_FALSE(std::isnan(point.minDihedralDeg) || std::isnan(point.maxDihedralDeg));
}

TEST(MeshQuality, OfABccBlock) {
  const MeshQuality q = meshQuality(test::bccBlock({4, 3, 5}));
  const std::int64_t innerFaces = 3 * 3 * 5 + 4 * 2 * 5 + 4 * 3 * 4;
  EXPECT_EQ(q.tets, 4 * innerFaces);
  EXPECT_NEAR(q.maxAspectRatio, std::sqrt(2.0), kExact);
  EXPECT_NEAR(q.meanAspectRatio, std::sqrt(2.0), kExact);
  EXPECT_NEAR(q.minDihedralDeg, 60, kDegreeRounding);
  EXPECT_NEAR(q.maxDihedralDeg, 90, kDegreeRounding);
  EXPECT_NEAR(q.maxOverMinEdge, 2 / std::sqrt(3.0), kExact);
  EXPECT_NEAR(q.volume, static_cast<double>(q.tets) / 12, 1e-10);
  EXPECT_EQ(q.inverted, 0);
}

TEST(MeshQuality, FindsTheWorstAndTheInverted) {
  TetMesh mesh = test::bccBlock({2, 2, 2});
  const auto cornerOfACube = static_cast<std::int32_t>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), {{9, 0, 0}, {10, 0, 0}, {9, 1, 0}, {9, 0, 1}});
  mesh.tets.insert(mesh.tets.begin() + 5,
                   {cornerOfACube, cornerOfACube + 1, cornerOfACube + 2, cornerOfACube + 3});
  std::swap(mesh.tets[7][0], mesh.tets[7][1]);
  const MeshQuality q = meshQuality(mesh);
  EXPECT_EQ(q.largestAspectRatios[0].tet, 5);
  EXPECT_NEAR(q.maxAspectRatio, std::sqrt(6.0), kExact);
  EXPECT_EQ(q.inverted, 1);
}

TEST(MeshQuality, AFlatTetCountsAsInvertedAndLeavesTheMean) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 4, 2}};
  const MeshQuality q = meshQuality(mesh);
  EXPECT_EQ(q.inverted, 1);
  EXPECT_EQ(q.largestAspectRatios[0].tet, 1);
  EXPECT_TRUE(std::isinf(q.maxAspectRatio));
  EXPECT_NEAR(q.meanAspectRatio, std::sqrt(6.0), kExact);
}

TEST(MeshQuality, OfNothingIsZero) {
  const MeshQuality q = meshQuality({});
  EXPECT_EQ(q.tets, 0);
  EXPECT_EQ(q.maxAspectRatio, 0);
  EXPECT_TRUE(q.largestAspectRatios.empty());
}

TEST(MeshQuality, SameBitsForAnyNumberOfThreads) {
  TetMesh mesh = test::bccBlock({10, 10, 10});  // more than one task
  std::mt19937 random(5);
  for (Vector3d& x : mesh.nodes)
    for (double& c : x) c += double(random()) / 4294967296.0 / 10;
  const auto withThreads = [&](std::size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return meshQuality(mesh);
  };
  const MeshQuality one = withThreads(1), four = withThreads(4);
  EXPECT_GT(one.tets, 10000);
  EXPECT_EQ(one.meanAspectRatio, four.meanAspectRatio);
  EXPECT_EQ(one.volume, four.volume);
  for (const auto list : kRankings)
    for (std::size_t i = 0; i < kRankedTets; ++i) {
      EXPECT_EQ((one.*list)[i].tet, (four.*list)[i].tet);
      EXPECT_EQ((one.*list)[i].value, (four.*list)[i].value);
    }
}

TEST(MeshQuality, RanksLikeAStableSortOfAllTets) {
  TetMesh mesh = test::bccBlock({9, 9, 9});
  std::mt19937 random(8);
  // The nodes of one half stay, so that many tets are equal.
  for (std::size_t n = 0; n < mesh.nodes.size() / 2; ++n)
    for (double& x : mesh.nodes[n]) x += 0.1 * double(random()) / 4294967296.0;
  const MeshQuality q = meshQuality(mesh);
  const auto expectRanking = [&](const std::vector<RankedTet>& found, double TetQuality::*measure,
                                 double sign) {
    std::vector<RankedTet> all;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto& [a, b, c, d] = mesh.tets[t];
      all.push_back(
          {std::int64_t(t), tetQuality(mesh.nodes[a], mesh.nodes[b], mesh.nodes[c], mesh.nodes[d]).*measure});
    }
    std::stable_sort(all.begin(), all.end(),
                     [&](const RankedTet& l, const RankedTet& r) { return sign * l.value > sign * r.value; });
    ASSERT_EQ(found.size(), kRankedTets);
    for (std::size_t i = 0; i < kRankedTets; ++i) {
      EXPECT_EQ(found[i].tet, all[i].tet) << i;
      EXPECT_EQ(found[i].value, all[i].value) << i;
    }
  };
  expectRanking(q.largestAspectRatios, &TetQuality::aspectRatio, 1);
  expectRanking(q.smallestDihedrals, &TetQuality::minDihedralDeg, -1);
  expectRanking(q.largestDihedrals, &TetQuality::maxDihedralDeg, 1);
  EXPECT_EQ(q.largestAspectRatios[0].value, q.maxAspectRatio);
}

TEST(MeshQuality, RanksNoMoreThanThereAre) {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  const MeshQuality q = meshQuality(mesh);
  for (const auto list : kRankings) {
    ASSERT_EQ((q.*list).size(), 2u);
    EXPECT_EQ((q.*list)[0].tet, 0) << "the first of equals";
    EXPECT_EQ((q.*list)[1].tet, 1);
  }
}

TEST(DihedralAngles, LieAtTheEdgesOppositeToTheirNumber) {
  // A corner of a cube: right angles at the three edges of the corner, acos(1 / sqrt 3) at the others.
  const std::array<double, 6> angles = dihedralAnglesDeg({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  for (int e = 0; e < 6; ++e) {
    const bool atCorner = kTetEdges[5 - e][0] == 0;
    EXPECT_NEAR(angles[e], atCorner ? 90 : degrees(std::acos(1 / std::sqrt(3.0))), kDegreeRounding) << e;
  }
}

}  // namespace
}  // namespace sinew
