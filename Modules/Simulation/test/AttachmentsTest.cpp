#include "sinew/Simulation/Attachments.h"
#include "sinew/TestSupport/ElasticBars.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Nodes = std::vector<std::int32_t>;

/// 2 x 3 x 10 mm along z, turned and moved.
struct TurnedBar {
  Eigen::Isometry3d frame =
      Eigen::Translation3d(30, -70, 5) * Eigen::AngleAxisd(0.5, Vector3d(1, 2, 0.3).normalized());
  TetMesh straight = test::barMesh({2, 3, 10}, 1);
  TetMesh mesh = straight;
  TurnedBar() {
    for (Vector3d& x : mesh.nodes) x = frame * x;
  }
  Nodes nodesWhere(const std::function<bool(const Vector3d&)>& is) const {
    Nodes nodes;
    for (std::size_t n = 0; n < straight.nodes.size(); ++n)
      if (is(straight.nodes[n])) nodes.push_back(static_cast<std::int32_t>(n));
    return nodes;
  }
};

std::string messageOf(const std::function<void()>& action) {
  return test::messageOf<std::invalid_argument>(action);
}

TEST(Attachments, TheLongAxisIsThatOfABar) {
  const TurnedBar bar;
  EXPECT_LT((longAxis(bar.mesh) - bar.frame.linear() * Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Attachments, EndsTakeTheirShareOfTheLength) {
  const TurnedBar bar;
  for (const double share : {0.1001, 0.2501, 0.4999}) {  // nodes stand at tenths
    const Attachments ends = endsOf(bar.mesh, share);
    EXPECT_EQ(ends.origin, bar.nodesWhere([&](const Vector3d& x) { return x.z() >= 10 * (1 - share); }));
    EXPECT_EQ(ends.insertion, bar.nodesWhere([&](const Vector3d& x) { return x.z() <= 10 * share; }));
    EXPECT_NO_THROW(checkApart(ends));
  }
  EXPECT_EQ(messageOf([&] { endsOf(bar.mesh, 0.5); }), "a share of 0.5; it must be above 0 and below 0.5");
  EXPECT_EQ(messageOf([&] { endsOf(bar.mesh, 0); }), "a share of 0; it must be above 0 and below 0.5");
}

TEST(Attachments, ContactIsWhereTheNeighbourIsNear) {
  const TurnedBar bar;
  TetMesh neighbour = test::barMesh({6, 6, 2}, 1);
  for (Vector3d& x : neighbour.nodes) x = bar.frame * (x + Vector3d(-2, -2, 10.3));
  const Nodes top = bar.nodesWhere([](const Vector3d& x) { return x.z() > 9.9; });
  EXPECT_EQ(contactNodes(bar.mesh, neighbour), top) << "the mean boundary edge is above 1 mm";
  EXPECT_EQ(contactNodes(bar.mesh, neighbour, 0.31), top);
  EXPECT_EQ(contactNodes(bar.mesh, neighbour, 1.31), bar.nodesWhere([](const Vector3d& x) {
    const bool boundary = x.x() < 0.1 || x.x() > 1.9 || x.y() < 0.1 || x.y() > 2.9;
    return x.z() > 9.9 || (x.z() > 8.9 && boundary);
  }));
  EXPECT_EQ(messageOf([&] { contactNodes(bar.mesh, neighbour, 0.25); }),
            "no node lies within 0.25 mm; the nearest is 0.3 mm away");
}

// The neighbour's faces, edges and corners are all nearest to some node.
TEST(Attachments, ContactWithATetIsTheExactDistance) {
  const TetMesh bar = test::barMesh({4, 4, 4}, 1);
  TetMesh tet{{{6, 1, 1}, {9, 1, 1}, {6, 3.5, 1}, {6, 1, 3.5}}, {{0, 1, 2, 3}}, {1}, {}};
  const auto toTriangle = [&](const Vector3d& x) {  // the face towards the bar, in the plane of x = 6
    double least = std::numeric_limits<double>::infinity();
    for (double s = 0; s <= 1; s += 0.01)
      for (double t = 0; s + t <= 1; t += 0.01)
        least = std::min(least, (Vector3d(6, 1 + 2.5 * s, 1 + 2.5 * t) - x).norm());
    return least;
  };
  std::vector<std::pair<std::int32_t, double>> boundary;
  for (std::size_t n = 0; n < bar.nodes.size(); ++n) {
    const Vector3d& x = bar.nodes[n];
    if ((x.array() < 0.1).any() || (x.array() > 3.9).any())
      boundary.emplace_back(static_cast<std::int32_t>(n), toTriangle(x));
  }
  for (const double distance : {2.0001, 2.2, 2.5, 3.}) {
    Nodes wanted;
    for (const auto& [node, away] : boundary)
      if (away <= distance) wanted.push_back(node);
    EXPECT_EQ(contactNodes(bar, tet, distance), wanted) << distance;
  }
}

TEST(Attachments, BoxesHoldTheNodesInThem) {
  const TetMesh bar = test::barMesh({2, 3, 10}, 1);
  EXPECT_EQ(nodesIn(bar, {Vector3d(-1, -1, -1), Vector3d(5, 5, 0)}).size(), 12u);
  EXPECT_EQ(messageOf([&] {
              nodesIn(bar, {Vector3d(5, 0, 0), Vector3d(6, 1, 1)});
            }),
            "no node lies in the box; the mesh lies from 0, 0, 0 to 2, 3, 10 mm");
}

TEST(Attachments, MayNotOverlap) {
  EXPECT_EQ(messageOf([] {
              checkApart({{3, 1, 2}, {2, 5, 3}});
            }),
            "origin and insertion share 2 nodes; choose attachments that lie apart, or that reach less far");
}

TEST(Attachments, TendonsFallToZeroAwayFromTheEnds) {
  const TetMesh bar = test::barMesh({1, 1, 40}, 0.25);
  const Attachments ends = endsOf(bar, 0.05);
  const std::vector<double> shares = tendonShares(bar, ends, 0.2);
  for (std::size_t t = 0; t < shares.size(); ++t) {
    double z = 0;
    for (const std::int32_t node : bar.tets[t]) z += bar.nodes[static_cast<std::size_t>(node)].z() / 40;
    const double fromEnd = std::min(z, 1 - z);
    EXPECT_NEAR(shares[t], fromEnd < 0.2 ? 1 : fromEnd > 0.3 ? 0 : (0.3 - fromEnd) / 0.1, 1e-9);
  }
  EXPECT_EQ(tendonShares(bar, ends, 0), std::vector<double>(bar.tets.size(), 0));
  EXPECT_EQ(messageOf([&] { tendonShares(bar, ends, -0.1); }),
            "a share of -0.1; it must be 0 or more and below 0.5");
}

TEST(Attachments, TheMeanBoundaryEdgeIsThatOfItsTriangles) {
  // Each face of a cube has two triangles with edges 1, 1 and sqrt 2.
  EXPECT_NEAR(meanBoundaryEdge(test::barMesh({3, 3, 3}, 2)), 2 * (2 + std::sqrt(2.)) / 3, 1e-12);
}

}  // namespace
}  // namespace sinew
