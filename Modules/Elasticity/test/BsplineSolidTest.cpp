#include "sinew/Elasticity/BsplineSolid.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Counts = std::array<int, 3>;
using Map = std::function<Vector3d(const Vector3d&)>;

/// The grid whose spline is `map` where that is linear in each parameter: the control points are its values
/// at the Greville abscissae, the means of three knots each.
NodeVectors grid(const Counts& counts, const Map& map) {
  const auto abscissa = [](int i, int count) {
    const int degree = std::min(3, count - 1), spans = count - degree;
    double sum = 0;
    for (int k = i + 1; k <= i + degree; ++k)
      sum += std::clamp(static_cast<double>(k - degree) / spans, 0., 1.);
    return sum / degree;
  };
  NodeVectors points;
  for (int k = 0; k < counts[2]; ++k)
    for (int j = 0; j < counts[1]; ++j)
      for (int i = 0; i < counts[0]; ++i)
        points.push_back(map({abscissa(i, counts[0]), abscissa(j, counts[1]), abscissa(k, counts[2])}));
  return points;
}

constexpr double kTurn = 1.2;

/// A bar of 20 x 20 x 60 mm whose lines along w lean around its axis: linear in each parameter.
Vector3d twisted(const Vector3d& p) {
  const double x = p.x() - 0.5, y = p.y() - 0.5;
  return {20 * (x - kTurn * y * p.z()), 20 * (y + kTurn * x * p.z()), 60 * p.z()};
}

/// A quarter of a ring about y, of radius 30 in the middle: w turns.
Vector3d bent(const Vector3d& p) {
  const double radius = 30 + 10 * (p.x() - 0.5), angle = 1.5 * p.z();
  return {-radius * std::cos(angle), 10 * p.y(), radius * std::sin(angle)};
}

BsplineSolid bentSolid() { return {{4, 4, 9}, grid({4, 4, 9}, bent)}; }

NodeVectors randomParameters(unsigned seed) {
  NodeVectors parameters = test::randomVectors(200, 0.5, seed);
  for (Vector3d& p : parameters) p.array() += 0.5;
  return parameters;
}

TEST(BsplineSolid, OfAnAffineGridIsAffine) {
  Matrix3d edges;
  edges << 20, 3, 10, -4, 15, 5, 2, 1, 60;
  const Vector3d corner(7, -30, 100);
  for (const Counts& counts : {Counts{4, 4, 4}, Counts{5, 4, 9}, Counts{2, 3, 7}}) {
    const BsplineSolid solid(counts, grid(counts, [&](const Vector3d& p) { return corner + edges * p; }));
    for (const Vector3d& p : randomParameters(1)) {
      const Vector3d x = corner + edges * p;
      EXPECT_LT((solid.at(p).x - x).norm(), 1e-12 * x.norm());
      EXPECT_LT((solid.at(p).slopes - edges).norm(), 1e-12 * edges.norm());
      EXPECT_LT((solid.nearest(x) - p).norm(), 1e-9);  // Newton ends at steps of 1e-12
      EXPECT_LT((solid.fibre(x) - edges.col(2).normalized()).norm(), 1e-9);
    }
  }
}

TEST(BsplineSolid, OfATwistedGridIsTwisted) {
  const BsplineSolid solid({4, 5, 8}, grid({4, 5, 8}, twisted));
  for (const Vector3d& p : randomParameters(2)) {
    const double x = p.x() - 0.5, y = p.y() - 0.5;
    const Vector3d fibre = Vector3d(-20 * kTurn * y, 20 * kTurn * x, 60).normalized();
    EXPECT_LT((solid.at(p).x - twisted(p)).norm(), 1e-12 * 60);
    EXPECT_LT((solid.nearest(twisted(p)) - p).norm(), 1e-9);
    EXPECT_LT((solid.fibre(twisted(p)) - fibre).norm(), 1e-9);
  }
}

TEST(BsplineSolid, FibresAreUnitVectorsAndContinuousAcrossSpans) {
  const BsplineSolid solid = bentSolid();
  // In six spans over 1.5 rad fibres turn by h / r for a step h at the radius r >= 25.
  constexpr double kStep = 0.01;
  const Vector3d side(0, 3, 0);
  Vector3d before = solid.fibre(side + Vector3d(-30, 0, 0));
  for (double angle = 0; angle < 1.5; angle += kStep / 30) {
    const Vector3d fibre = solid.fibre(side + 30 * Vector3d(-std::cos(angle), 0, std::sin(angle)));
    EXPECT_NEAR(fibre.norm(), 1, 1e-12);
    EXPECT_LT((fibre - before).norm(), 2 * kStep / 25);
    before = fibre;
  }
}

// Who follows a fibre from the one tendon arrives at the other.
TEST(BsplineSolid, FibresRunFromTendonToTendon) {
  const BsplineSolid solid = bentSolid();
  Vector3d x = solid.at({0.3, 0.6, 0}).x;
  constexpr double kStep = 0.05;
  for (int step = 0; step < 2000 && solid.nearest(x).z() < 1; ++step) {
    const Vector3d middle = x + kStep / 2 * solid.fibre(x);
    x += kStep * solid.fibre(middle);
  }
  const Vector3d end = solid.nearest(x);
  EXPECT_EQ(end.z(), 1);
  EXPECT_NEAR(end.x(), 0.3, 1e-3);  // of second order in the step, 10 mm wide
  EXPECT_NEAR(end.y(), 0.6, 1e-3);
}

TEST(BsplineSolid, PointsOutsideGetTheNearestPoint) {
  const BsplineSolid box({4, 4, 4}, grid({4, 4, 4}, [](const Vector3d& p) { return Vector3d(10 * p); }));
  for (const Vector3d& offset : test::randomVectors(200, 20, 3)) {
    const Vector3d x = Vector3d(5, 5, 5) + offset;
    const Vector3d wanted = (x / 10).cwiseMax(0).cwiseMin(1);
    EXPECT_LT((box.nearest(x) - wanted).norm(), 1e-9) << x.transpose();
  }
  // Off a bent face the offset is square to it.
  const BsplineSolid solid = bentSolid();
  for (const double w : {0.1, 0.35, 0.5, 0.8}) {
    const BsplineSolid::Place place = solid.at({1, 0.4, w});
    const Vector3d normal = place.slopes.col(1).cross(place.slopes.col(2)).normalized();
    const double outwards = normal.dot(place.slopes.col(0)) > 0 ? 1 : -1;
    EXPECT_LT((solid.nearest(place.x + 4 * outwards * normal) - Vector3d(1, 0.4, w)).norm(), 1e-6);
  }
}

// Muscles taper: all points of the first layer may be one.
TEST(BsplineSolid, MayTaperToAPoint) {
  NodeVectors points = grid({4, 4, 6}, twisted);
  std::fill_n(points.begin(), 16, Vector3d(0, 0, -10));
  const BsplineSolid solid({4, 4, 6}, points);
  const Vector3d fibre = solid.fibre({0, 0, -10});
  EXPECT_NEAR(fibre.norm(), 1, 1e-12);
  EXPECT_GT(fibre.z(), 0.5);  // towards the end, whichever line of w is taken
}

TEST(BsplineSolid, TetsGetTheFibreOfTheirCentroid) {
  const TetMesh mesh = test::barMesh({2, 2, 4}, 5);
  const BsplineSolid solid({4, 4, 6}, grid({4, 4, 6}, twisted));
  const auto [fibres, distances] = splineFibres(mesh, solid);
  ASSERT_EQ(fibres.size(), mesh.tets.size());
  for (std::size_t t = 0; t < fibres.size(); ++t) {
    Vector3d centre = Vector3d::Zero();
    for (const std::int32_t node : mesh.tets[t]) centre += mesh.nodes[static_cast<std::size_t>(node)] / 4;
    EXPECT_LT((fibres[t] - solid.fibre(centre)).norm(), 1e-9) << t;  // centroids differ by round-off
  }
}

TEST(BsplineSolid, TetsKnowHowFarFromItTheyLie) {
  TetMesh mesh = test::barMesh({2, 2, 2}, 1);
  const BsplineSolid box({2, 2, 2}, grid({2, 2, 2}, [](const Vector3d& p) { return Vector3d(2 * p); }));
  for (const double distance : splineFibres(mesh, box).distances) EXPECT_LT(distance, 1e-9);  // round-off
  for (Vector3d& x : mesh.nodes) x.x() += 10;
  const std::vector<double> distances = splineFibres(mesh, box).distances;
  EXPECT_NEAR(*std::ranges::min_element(distances), 8.25, 1e-9);  // centroids lie in quarters
  EXPECT_NEAR(*std::ranges::max_element(distances), 9.75, 1e-9);
}

std::string refusal(const Counts& counts, const NodeVectors& points) {
  try {
    const BsplineSolid solid(counts, points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(BsplineSolid, RefusesWhatIsNoSolid) {
  EXPECT_EQ(refusal({4, 4, 1}, {}), "1 control points along w; at least 2 are needed");
  EXPECT_EQ(refusal({4, 4, 4}, NodeVectors(63)), "63 control points; the counts ask for 64");
  NodeVectors folded = grid({2, 2, 6}, twisted);
  std::swap_ranges(folded.begin(), folded.begin() + 4, folded.begin() + 16);  // layers 0 and 4
  EXPECT_TRUE(refusal({2, 2, 6}, folded).starts_with("the solid is folded or flat at u, v, w = "));
  const NodeVectors flat = grid({2, 2, 2}, [](const Vector3d& p) { return Vector3d(p.x(), p.y(), 0); });
  EXPECT_EQ(refusal({2, 2, 2}, flat), "the solid is folded or flat at u, v, w = 0.167, 0.167, 0.167");
}

}  // namespace
}  // namespace sinew
