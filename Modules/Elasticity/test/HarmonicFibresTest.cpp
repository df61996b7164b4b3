#include "sinew/Elasticity/HarmonicFibres.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Nodes = std::vector<std::int32_t>;

Nodes nodesWhere(const TetMesh& mesh, const std::function<bool(const Vector3d&)>& is) {
  Nodes nodes;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (is(mesh.nodes[n])) nodes.push_back(static_cast<std::int32_t>(n));
  return nodes;
}

Nodes bottom(const TetMesh& mesh) {
  return nodesWhere(mesh, [](const Vector3d& x) { return x.z() < 1e-9; });
}
Nodes top(const TetMesh& mesh, double height) {
  return nodesWhere(mesh, [&](const Vector3d& x) { return x.z() > height - 1e-9; });
}

// Linear elements hold the linear field of a straight bar exactly.
TEST(HarmonicFibres, OfAStraightBarAreStraight) {
  const TetMesh mesh = test::barMesh({2, 3, 6}, 1);
  for (const Vector3d& fibre : harmonicFibres(elasticBody(mesh), bottom(mesh), top(mesh, 6)))
    EXPECT_LT((fibre - Vector3d::UnitZ()).norm(), 1e-7);
}

// A quarter of a ring: u grows with the angle, so fibres are circles.
TEST(HarmonicFibres, OfABentBarFollowItsBend) {
  TetMesh mesh = test::barMesh({4, 4, 24}, 1);
  const Nodes start = bottom(mesh), end = top(mesh, 24);
  for (Vector3d& x : mesh.nodes) {
    const double angle = x.z() / 24 * std::numbers::pi / 2, radius = 12 + x.x();
    x = {radius * std::cos(angle), x.y(), radius * std::sin(angle)};
  }
  const ElasticBody body = elasticBody(mesh);
  const NodeVectors fibres = harmonicFibres(body, start, end);
  for (std::size_t t = 0; t < fibres.size(); ++t) {
    Vector3d centre = Vector3d::Zero();
    for (const std::int32_t node : mesh.tets[t]) centre += mesh.nodes[static_cast<std::size_t>(node)] / 4;
    const Vector3d along = Vector3d(-centre.z(), 0, centre.x()).normalized();
    EXPECT_NEAR(fibres[t].norm(), 1, 1e-12);
    EXPECT_GT(fibres[t].dot(along), std::cos(0.12));  // h / r = 1 / 12, of first order in each tet
  }
}

TEST(HarmonicFibres, ThereAreNoneInAPieceWithoutAttachment) {
  TetMesh mesh = test::barMesh({1, 1, 2}, 1);
  const std::size_t tets = mesh.tets.size();
  const TetMesh other = test::barMesh({1, 1, 1}, 1);
  const auto shift = static_cast<std::int32_t>(mesh.nodes.size());
  const Nodes start = bottom(mesh), end = top(mesh, 2);
  for (const Vector3d& x : other.nodes) mesh.nodes.push_back(x + Vector3d(5, 0, 0));
  for (Tet tet : other.tets) {
    for (std::int32_t& node : tet) node += shift;
    mesh.tets.push_back(tet);
  }
  const NodeVectors fibres = harmonicFibres(elasticBody(mesh), start, end);
  for (std::size_t t = 0; t < fibres.size(); ++t) EXPECT_EQ(fibres[t].isZero(), t >= tets) << t;
}

TEST(HarmonicFibres, RefuseAttachmentsThatAreNone) {
  const TetMesh mesh = test::barMesh({1, 1, 2}, 1);
  const ElasticBody body = elasticBody(mesh);
  EXPECT_THROW(harmonicFibres(body, {}, {1}), std::invalid_argument);
  EXPECT_THROW(harmonicFibres(body, {1}, {1}), std::invalid_argument);
  EXPECT_THROW(harmonicFibres(body, {0}, {99}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
