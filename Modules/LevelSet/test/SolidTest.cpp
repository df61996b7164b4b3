#include "Sampling.h"
#include "SolidShapes.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using test::sampled;
using test::volumeOf;

using std::numbers::pi;

/// Volume of the convex hull of two balls of radii R and r, their centres h apart.
double roundConeVolume(double R, double r, double h) {
  const double slope = (R - r) / h, flat = std::sqrt(1 - slope * slope);
  const auto cap = [](double radius, double height) { return pi * height * height * (radius - height / 3); };
  const double foot = R * flat, rim = r * flat, height = h - (R - r) * slope;
  return cap(R, R * (1 + slope)) + cap(r, r * (1 - slope)) +
         pi * height / 3 * (foot * foot + foot * rim + rim * rim);
}

struct Known {
  const char* name;
  Solid solid;
  double volume;
};

const std::vector<Known>& solids() {
  static const std::vector<Known> all{
      {"sphere", sphere({1, 2, 3}, 9), 4 * pi / 3 * 729},
      {"ellipsoid", ellipsoid({1, 2, 3}, {12, 8, 6}), 4 * pi / 3 * 12 * 8 * 6},
      {"box", box({-8, -6, -4}, {9, 7, 5}), 17 * 13 * 9},
      {"rounded box", box({-8, -6, -4}, {9, 7, 5}, 3),
       11 * 7 * 3 + 2 * 3 * (11 * 7 + 7 * 3 + 3 * 11) + pi * 9 * (11 + 7 + 3) + 4 * pi / 3 * 27},
      {"cylinder", cylinder({-5, 2, -4}, {6, 5, 9}, 6), pi * 36 * Vector3d(11, 3, 13).norm()},
      {"capsule", capsule({-5, 2, -4}, {6, 5, 9}, 6), pi * 36 * (Vector3d(11, 3, 13).norm() + 4.0 / 3 * 6)},
      {"cone", cone({-5, 2, -4}, {6, 5, 9}, 9), pi * 81 * Vector3d(11, 3, 13).norm() / 3},
      {"frustum", cone({-5, 2, -4}, {6, 5, 9}, 4, 9), pi * (16 + 36 + 81) * Vector3d(11, 3, 13).norm() / 3},
      {"torus", torus({1, 2, 3}, {1, -2, 4}, 10, 4), 2 * pi * pi * 10 * 16},
      {"round cone", tube({{-5, 2, -4}, {6, 5, 9}}, {8, 4}),
       roundConeVolume(8, 4, Vector3d(11, 3, 13).norm())},
      {"straight tube", tube({{-5, 2, -4}, {0.5, 3.5, 2.5}, {6, 5, 9}}, {6}),
       pi * 36 * (Vector3d(11, 3, 13).norm() + 4.0 / 3 * 6)},
      {"ball in a ball", tube({{0, 0, 0}, {3, 0, 0}}, {4, 9}), 4 * pi / 3 * 729},
      {"octahedron",
       convexHull({{9, 0, 0}, {-9, 0, 0}, {0, 9, 0}, {0, -9, 0}, {0, 0, 9}, {0, 0, -9}, {1, 1, 1}}),
       4.0 / 3 * 729}};
  return all;
}

/// By differences; its length is below one where the surface's closest point jumps.
Vector3d gradientOf(const Solid& solid, const Vector3d& x) {
  constexpr double step = 1e-5;
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d along = step * Vector3d::Unit(axis);
    gradient[axis] = (solid.phi(x + along) - solid.phi(x - along)) / (2 * step);
  }
  return gradient;
}

TEST(Solid, PhiIsTheDistanceToTheSurface) {
  std::mt19937 random(7);
  for (const Known& known : solids()) {
    SCOPED_TRACE(known.name);
    int met = 0;
    for (int n = 0; n < 2000; ++n) {
      const Vector3d x = test::pointIn(random, 20), y = x + test::pointIn(random, 1);
      const double phi = known.solid.phi(x);
      // No surface nearer than |phi| ...
      ASSERT_LE(std::abs(phi - known.solid.phi(y)), (x - y).norm() + 1e-9);
      if (!known.solid.distance) continue;
      // ... and one that far away, straight down the gradient.
      const Vector3d gradient = gradientOf(known.solid, x);
      if (std::abs(gradient.norm() - 1) > 1e-6) continue;
      ASSERT_NEAR(known.solid.phi(x - phi * gradient), 0, 1e-4) << x.transpose();
      ++met;
    }
    EXPECT_GT(met, known.solid.distance ? 1800 : -1);  // all but those beside a medial surface
  }
}

TEST(Solid, VolumesAreWithinHalfAPercent) {
  for (const Known& known : solids()) {
    const DenseLevelSet levelSet = sampled(known.solid);
    EXPECT_NEAR(volumeOf(levelSet), known.volume, 0.005 * known.volume) << known.name;
  }
}

TEST(Solid, BoundsTouchTheSurface) {
  for (const Known& known : solids()) {
    AlignedBox3d touched;
    test::forEachCrossing(sampled(known.solid), [&](const Vector3d& x) { touched.extend(x); });
    const AlignedBox3d& bounds = known.solid.bounds;
    // The cone's tip and the octahedron's corners are lost between the samples, up to two of them.
    EXPECT_TRUE(((touched.min() - bounds.min()).array() > -0.3).all()) << known.name;
    EXPECT_TRUE(((bounds.max() - touched.max()).array() > -0.3).all()) << known.name;
    EXPECT_LT((touched.min() - bounds.min()).maxCoeff(), 2) << known.name;
    EXPECT_LT((bounds.max() - touched.max()).maxCoeff(), 2) << known.name;
  }
}

TEST(Solid, SamplesAreTheFormulaWithinTheBand) {
  constexpr double band = 3;
  for (const Known& known : solids()) {
    if (!known.solid.distance) continue;
    SCOPED_TRACE(known.name);
    const DenseLevelSet levelSet = sampled(known.solid, band, test::tiltedLattice(0.7));
    test::forEachSample(levelSet, [&](const Vector3d& x, double phi) {
      ASSERT_NEAR(phi, std::clamp(known.solid.phi(x), -band, band), 1e-5);  // single precision
    });
  }
}

TEST(Solid, SamplesOfAFormulaThatIsNoDistanceBecomeOne) {
  const Solid egg = ellipsoid({0, 0, 0}, {14, 9, 9});
  double sum = 0;
  int count = 0;
  test::forEachSample(sampled(egg), [&](const Vector3d& x, double phi) {
    if (std::abs(phi) > 2.5) return;
    // Beside the surface  phi / |grad phi|  is the distance, up to the curvature: phi^2 / (2 * 5 mm).
    const double f = egg.phi(x) / gradientOf(egg, x).norm();
    sum += std::abs(phi - f) / (0.02 + phi * phi / 10);
    ++count;
    ASSERT_NEAR(phi, f, 0.05 + phi * phi / 5);
  });
  EXPECT_LT(sum / count, 1);
}

TEST(Solid, ATubeIsTheUnionOfItsPieces) {
  std::mt19937 random(9);
  std::vector<Vector3d> points;
  std::vector<double> radii;
  for (int n = 0; n < 23; ++n) {
    points.push_back(test::pointIn(random, 15));
    radii.push_back(1 + n % 5);
  }
  points[5] = points[4];  // one ball in another
  const Solid whole = tube(points, radii);
  std::vector<Solid> pieces;
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    pieces.push_back(tube({points[n], points[n + 1]}, {radii[n], radii[n + 1]}));
  for (int n = 0; n < 2000; ++n) {
    const Vector3d x = test::pointIn(random, 30);
    double least = std::numeric_limits<double>::infinity();
    for (const Solid& piece : pieces) least = std::min(least, piece.phi(x));
    ASSERT_EQ(whole.phi(x), least);
  }
}

TEST(Solid, TheSamplesLieOnTheLattice) {
  const SampleLattice lattice = test::tiltedLattice(0.7);
  const DenseLevelSet levelSet = sampled(sphere({30, 20, 10}, 5), 3, lattice);
  EXPECT_TRUE(firstSampleOn(lattice, levelSet).has_value());
  EXPECT_EQ(levelSet.voxelSize, 0.7);
  EXPECT_EQ(levelSet.band, 3);
  EXPECT_LE(levelSet.phi.size.maxCoeff(), (10 + 6) * 1.5 / 0.7 + 6);  // the tilted box of a ball's box
}

TEST(Solid, WhatLiesOutsideOfTheBoxIsCutOff) {
  const AlignedBox3d within(Vector3d(-9, -8, -7), Vector3d(9, 8, 7));
  const SampleLattice lattice = test::tiltedLattice(0.5);
  const DenseLevelSet half = sampleSolid(halfSpace({0, 0, 1}, {0, 0, 2}), lattice, 4, within);
  EXPECT_NEAR(volumeOf(half), 18 * 16 * 8, 0.005 * 18 * 16 * 8);
  const DenseLevelSet ball = sampleSolid(sphere({0, 0, 7}, 5), lattice, 4, within);
  EXPECT_NEAR(volumeOf(ball), 2 * pi / 3 * 125, 0.005 * 2 * pi / 3 * 125);
  const DenseLevelSet none = sampleSolid(sphere({0, 0, 30}, 5), lattice, 4, within);
  for (const float phi : none.phi.values) EXPECT_EQ(phi, 4);
  const double inf = std::numeric_limits<double>::infinity();
  const AlignedBox3d below(Vector3d(-inf, -inf, -inf), Vector3d(inf, inf, 7));
  EXPECT_EQ(sampleSolid(sphere({0, 0, 7}, 5), lattice, 4, below).phi.values, ball.phi.values);
}

TEST(Solid, RefusesBoxesThatAreInfiniteOrTooLarge) {
  const SampleLattice lattice;
  EXPECT_EQ(test::messageOf<std::invalid_argument>([&] {
              sampleSolid(halfSpace({0, 0, 0}, {0, 0, 1}), lattice, 3, test::kEverywhere);
            }),
            "sampleSolid: the solid must end within a finite box");
  const std::string message = test::messageOf<std::invalid_argument>([&] {
    sampleSolid(sphere({0, 0, 0}, 100), lattice, 3, test::kEverywhere, 1000000);
  });
  EXPECT_NE(message.find("at most 1000000 samples are allowed"), std::string::npos) << message;
  EXPECT_THROW(sampleSolid(sphere({0, 0, 0}, 1e30), lattice, 3, test::kEverywhere), std::invalid_argument);
}

TEST(Solid, MovesRigidlyAndScalesEvenly) {
  const Eigen::Affine3d motion = Eigen::Translation3d(4, -3, 2) *
                                 Eigen::AngleAxisd(0.7, Vector3d(1, 1, 3).normalized()) * Eigen::Scaling(1.5);
  const Solid still = cone({-3, 0, 1}, {4, 2, 2}, 4, 1), solid = moved(still, motion);
  std::mt19937 random(3);
  for (int n = 0; n < 100; ++n) {
    const Vector3d x = test::pointIn(random, 10);
    EXPECT_NEAR(solid.phi(motion * x), 1.5 * still.phi(x), 1e-12);
    EXPECT_TRUE(still.phi(x) >= 0 || solid.bounds.contains(motion * x));
  }
  const double volume = pi * Vector3d(7, 2, 1).norm() * (16 + 4 + 1) / 3 * std::pow(1.5, 3);
  EXPECT_NEAR(volumeOf(sampled(solid, 2, test::tiltedLattice(0.5))), volume, 0.005 * volume);
  const Solid space = moved(halfSpace({0, 0, 0}, {0, 0, 1}), motion);
  EXPECT_FALSE(space.bounds.max().allFinite());
  Eigen::Affine3d shear = Eigen::Affine3d::Identity(), stretch = shear, nowhere = shear;
  shear(0, 1) = 0.1;
  stretch(0, 0) = 1.1;
  nowhere(0, 3) = std::nan("");
  for (const Eigen::Affine3d& bad : {shear, stretch, nowhere})
    EXPECT_THROW(moved(still, bad), std::invalid_argument);
}

TEST(Solid, AConvexHullIsWhatEveryHalfSpaceOfItsFacesHolds) {
  std::vector<Vector3d> corners;
  for (int n = 0; n < 8; ++n) corners.emplace_back(n & 1 ? 1004 : 1000, n & 2 ? 5 : -5, n & 4 ? 3 : -3);
  const Solid hull = convexHull(corners), cube = box({1000, -5, -3}, {1004, 5, 3});
  std::mt19937 random(5);
  for (int n = 0; n < 1000; ++n) {
    const Vector3d x = Vector3d(1002, 0, 0) + test::pointIn(random, 8);
    EXPECT_EQ(hull.phi(x) < 0, cube.phi(x) < 0);
    EXPECT_NEAR(std::min(hull.phi(x), 0.0), std::min(cube.phi(x), 0.0), 1e-9);
  }
  for (const Vector3d& corner : corners) EXPECT_NEAR(hull.phi(corner), 0, 1e-9);
}

TEST(Solid, TheNumberOfThreadsDoesNotShow) {
  for (const Known& known : solids()) {
    const auto run = [&] { return sampled(known.solid).phi.values; };
    EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run)) << known.name;
  }
}

TEST(Solid, RefusesWhatIsNoSolid) {
  const Vector3d o(0, 0, 0), x(1, 0, 0), nan(0, std::nan(""), 0);
  struct Case {
    const char* message;
    std::function<void()> make;
  };
  const std::vector<Case> cases{
      {"sphere: radius must be positive, got 0.000000", [&] { sphere(o, 0); }},
      {"sphere: center must be finite", [&] { sphere(nan, 1); }},
      {"ellipsoid: every radius must be positive, got -1.000000",
       [&] {
         ellipsoid(o, {1, -1, 1});
       }},
      {"box: min must be below max along every axis", [&] { box(o, x); }},
      {"box: rounding must be at most half of the shortest side, 0.500000, got 0.600000",
       [&] {
         box(o, {1, 2, 3}, 0.6);
       }},
      {"box: rounding must not be negative, got -1.000000",
       [&] {
         box(o, {1, 2, 3}, -1);
       }},
      {"cylinder: from and to must not be the same point", [&] { cylinder(x, x, 1); }},
      {"cylinder: radius must be positive, got nan", [&] { cylinder(o, x, std::nan("")); }},
      {"capsule: to must be finite", [&] { capsule(o, nan, 1); }},
      {"cone: radius and endRadius must not both be 0", [&] { cone(o, x, 0, 0); }},
      {"cone: endRadius must not be negative, got -2.000000", [&] { cone(o, x, 1, -2); }},
      {"torus: axis must not be zero", [&] { torus(o, o, 2, 1); }},
      {"torus: tube must be smaller than radius, 2.000000, got 2.000000", [&] { torus(o, x, 2, 2); }},
      {"halfSpace: normal must not be zero", [&] { halfSpace(o, o); }},
      {"tube: needs at least two points, got 1", [&] { tube({o}, {1}); }},
      {"tube: needs one radius for all or one for each of the 2 points, got 3",
       [&] {
         tube({o, x}, {1, 2, 3});
       }},
      {"tube: radius 1 must be positive, got 0.000000",
       [&] {
         tube({o, x}, {1, 0});
       }},
      {"convexHull: needs at least four points, got 3",
       [&] {
         convexHull({o, x, {0, 1, 0}});
       }},
      {"convexHull: point 1 must be finite",
       [&] {
         convexHull({o, nan, x, {0, 1, 0}});
       }},
      {"convexHull: the points must not lie in a plane",
       [&] {
         convexHull({o, x, {0, 1, 0}, {1, 1, 0}, {3, 4, 0}});
       }},
      {"convexHull: the points must not lie in a plane",
       [&] {
         convexHull({o, x, 2 * x, 3 * x});
       }},
      {"convexHull: the points must not lie in a plane", [&] {
         convexHull({x, x, x, x, x});
       }}};
  for (const Case& c : cases) EXPECT_EQ(test::messageOf<std::invalid_argument>(c.make), c.message);
}

}  // namespace
}  // namespace sinew
