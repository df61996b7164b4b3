#include "NodeStarEnergy.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * double(random_()) / 4294967296.0; }
  Vector3d point() {
    const double x = between(-1, 1), y = between(-1, 1);
    return {x, y, between(-1, 1)};
  }

 private:
  std::mt19937 random_;
};

double sixVolume(const Vector3d& x, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return (x - a).dot((b - a).cross(c - a));
}

/// The 24 tets around a lattice node, every node moved by up to `jitter`.
struct Star {
  std::vector<Vector3d> nodes;
  std::vector<StarFaceNodes> faces;
  Vector3d x;

  NodeStar at(const Vector3d& origin) const {
    NodeStar star;
    star.gather(faces, nodes, origin);
    return star;
  }
  NodeStar gathered() const { return at(x); }
};

Star jitteredStar(Random& random, double jitter) {
  const TetMesh mesh = test::bccBlock(
      {3, 3, 3}, [](const Vector3d& c) { return (c - Vector3d::Constant(1.5)).lpNorm<1>() < 0.8; });
  Star star{mesh.nodes, {}, Vector3d::Constant(1.5) + jitter * random.point()};
  std::int32_t centre = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if ((mesh.nodes[n] - Vector3d::Constant(1.5)).norm() < 1e-9) centre = static_cast<std::int32_t>(n);
  for (Vector3d& p : star.nodes) p += jitter * random.point();
  for (const Tet& tet : mesh.tets) {
    StarFaceNodes face{};
    int count = 0;
    for (const std::int32_t v : tet)
      if (v != centre) face[count++] = v;
    const auto& [a, b, c] = face;
    if (sixVolume(Vector3d::Constant(1.5), mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]) < 0)
      std::swap(face[1], face[2]);
    star.faces.push_back(face);
  }
  return star;
}

TEST(ShapeMeasure, IsOneForTheRegularTetAtAnySizeAndPlace) {
  for (const double size : {1e-3, 1.0, 50.0}) {
    const Vector3d at(3, -7, 11);
    const Vector3d x = at + size * Vector3d(-1, -1, 1), a = at + size * Vector3d(1, 1, 1),
                   b = at + size * Vector3d(-1, 1, -1), c = at + size * Vector3d(1, -1, -1);
    ASSERT_GT(sixVolume(x, a, b, c), 0);
    EXPECT_NEAR(shapeMeasure(x, a, b, c), 1, 1e-10);
  }
}

TEST(ShapeMeasure, OfABccTet) {
  // Two edges 1 and four of sqrt(3)/2: L = 5, 6V = 1/2.
  EXPECT_NEAR(shapeMeasure({.5, -.5, .5}, {0, 0, 0}, {1, 0, 0}, {.5, .5, .5}), 125.0 / 108, 1e-14);
}

TEST(ShapeMeasure, IsAtLeastOneAndDoesNotDependOnTheNodeItIsSeenFrom) {
  Random random(31);
  for (int k = 0; k < 2000; ++k) {
    const Vector3d x = random.point(), a = random.point();
    Vector3d b = random.point(), c = random.point();
    if (sixVolume(x, a, b, c) < 0) std::swap(b, c);
    if (sixVolume(x, a, b, c) < 1e-3) continue;
    const double F = shapeMeasure(x, a, b, c);
    ASSERT_GE(F, 1 - 1e-12);
    ASSERT_NEAR(shapeMeasure(a, x, c, b), F, 1e-9 * F);
    ASSERT_NEAR(shapeMeasure(b, x, a, c), F, 1e-9 * F);
    ASSERT_EQ(shapeMeasure(x, a, c, b), kInfinity);  // inverted
  }
}

TEST(ShapeMeasure, IsInfiniteForAFlatTet) {
  EXPECT_EQ(shapeMeasure({.2, .2, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}), kInfinity);
}

TEST(Power, IsRepeatedMultiplication) {
  EXPECT_EQ(power(3, 0), 1);
  for (int q = 1; q <= 16; ++q) EXPECT_EQ(power(3, q), 3 * power(3, q - 1));  // exact below 2^53
}

TEST(NodeStarEnergy, IsTheSumOverTheTets) {
  Random random(32);
  const Star star = jitteredStar(random, 0.1);
  for (const int q : {1, 2, 8}) {
    double sum = 0, worst = 0;
    for (const auto& [a, b, c] : star.faces) {
      const double F = shapeMeasure(star.x, star.nodes[a], star.nodes[b], star.nodes[c]);
      sum += std::pow(F, q);
      worst = std::max(worst, F);
    }
    for (const Vector3d& origin : {star.x, Vector3d(star.x + 0.1 * Vector3d::Ones())}) {
      const StarValue value = star.at(origin).value(star.x, q);
      EXPECT_NEAR(value.energy, sum, 1e-12 * sum);
      EXPECT_NEAR(value.worst, worst, 1e-12 * worst);
    }
    EXPECT_NEAR(star.gathered().derivatives(q).energy, sum, 1e-12 * sum);
  }
}

TEST(NodeStarEnergy, IsInfiniteWhenOneTetIsNotPositive) {
  Random random(33);
  const Star star = jitteredStar(random, 0);
  const Vector3d outside = star.x + Vector3d(0, 0, 1.5);
  EXPECT_EQ(star.gathered().value(outside, 2).energy, kInfinity);
  EXPECT_EQ(star.gathered().value(outside, 2).worst, kInfinity);
}

TEST(NodeStarEnergy, DerivativesAgreeWithCentralDifferences) {
  // Error of central differences: h^2 f''' / 6 + eps f / h; h = 1e-5 leaves about 1e-7 of the largest entry.
  constexpr double h = 1e-5;
  for (const int q : {1, 2, 4, 16}) {
    Random random(34);
    for (int k = 0; k < 20; ++k) {
      SCOPED_TRACE("seed 34, q " + std::to_string(q) + ", star " + std::to_string(k));
      const Star star = jitteredStar(random, 0.12);
      const StarDerivatives d = star.gathered().derivatives(q);
      ASSERT_TRUE(std::isfinite(d.energy));
      Vector3d gradient;
      Matrix3d hessian;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d offset = h * Vector3d::Unit(axis);
        const auto plus = star.at(star.x + offset).derivatives(q);
        const auto minus = star.at(star.x - offset).derivatives(q);
        gradient[axis] = (plus.energy - minus.energy) / (2 * h);
        hessian.col(axis) = (plus.gradient - minus.gradient) / (2 * h);
      }
      EXPECT_LE((d.gradient - gradient).norm(), 1e-6 * (d.gradient.norm() + d.energy));
      EXPECT_LE((d.hessian - hessian).norm(), 1e-6 * d.hessian.norm());
      EXPECT_EQ(d.hessian, d.hessian.transpose());
    }
  }
}

TEST(NodeStarEnergy, IsStationaryAtTheCentreOfTheLatticeStar) {
  Random random(35);
  const Star star = jitteredStar(random, 0);
  const StarDerivatives d = star.gathered().derivatives(4);
  EXPECT_NEAR(d.gradient.norm(), 0, 1e-11 * d.energy);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix3d>(d.hessian).eigenvalues().minCoeff(), 0);
}

}  // namespace
}  // namespace sinew
