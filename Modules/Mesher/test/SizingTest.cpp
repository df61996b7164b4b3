#include "LatticeOracle.h"
#include "sinew/Mesher/Sizing.h"
#include "sinew/TestSupport/AnalyticDistance.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::AnalyticOptions;

constexpr double kNoBand = std::numeric_limits<double>::infinity();

/// A refined lattice and its leaves in mm.
struct Sized {
  int asked = 0;  ///< level of the edge length asked for
  LatticePlan plan;
  RedGreenLattice lattice;
  std::vector<LatticeTet> leaves;

  std::array<Vector3d, 4> corners(const LatticeTet& leaf) const {
    std::array<Vector3d, 4> x;
    for (int v = 0; v < 4; ++v) x[v] = plan.frame.position(leaf.nodes[v]);
    return x;
  }
  double longestEdge(const LatticeTet& leaf) const {
    const auto x = corners(leaf);
    double longest = 0;
    for (const auto& [a, b] : kTetEdges) longest = std::max(longest, (x[a] - x[b]).norm());
    return longest;
  }
};

Sized sized(const SignedDistance& phi, const SizingOptions& options) {
  LatticePlan plan = planLattice(phi, options);
  const int asked = plan.surfaceLevel;
  RedGreenLattice lattice(plan.coarseCells, plan.levels);
  refineToSize(lattice, plan, phi, options);
  std::vector<LatticeTet> leaves = test::allLeaves(lattice);
  return {asked, plan, std::move(lattice), std::move(leaves)};
}

/// Calls visit(point) on a regular grid of points of a tet, its corners included.
template <class Visit>
void forPointsIn(const std::array<Vector3d, 4>& x, int parts, const Visit& visit) {
  for (int a = 0; a <= parts; ++a)
    for (int b = 0; a + b <= parts; ++b)
      for (int c = 0; a + b + c <= parts; ++c)
        visit((a * x[0] + b * x[1] + c * x[2] + (parts - a - b - c) * x[3]) / parts);
}

bool changesSign(const Sized& s, const SignedDistance& phi, const LatticeTet& leaf) {
  int inside = 0;
  for (const Vector3d& x : s.corners(leaf)) inside += phi.value(x) < 0;
  return inside > 0 && inside < 4;
}

/// A sphere somewhere in a larger box: its place on the lattice is arbitrary.
class SphereInABox : public test::AnalyticSphere {
 public:
  SphereInABox(const Vector3d& center, double radius, double halfWidth, AnalyticOptions options)
      : AnalyticSphere(center, radius, options), halfWidth_(halfWidth) {}
  Eigen::AlignedBox3d bounds() const override {
    return {Vector3d::Constant(-halfWidth_), Vector3d::Constant(halfWidth_)};
  }

 private:
  double halfWidth_;
};

TEST(Sizing, PlanPutsTheEdgeLengthOnALevelAndOverhangsTheBounds) {
  const test::AnalyticSphere sphere({3, -4, 5}, 10, {.resolution = 0.6});
  const LatticePlan plan = planLattice(sphere, {.edgeLength = 1.5, .maxEdgeLength = 7, .minEdgeLength = 0.6});
  EXPECT_EQ(plan.levels, 4);  // 6, 3, 1.5 and 0.75 mm
  EXPECT_EQ(plan.surfaceLevel, 2);
  EXPECT_DOUBLE_EQ(plan.cubeSize(0), 6);
  EXPECT_DOUBLE_EQ(plan.cubeSize(plan.surfaceLevel), 1.5);
  EXPECT_DOUBLE_EQ(plan.cubeSize(3), 2 * plan.frame.halfCube);
  const Eigen::AlignedBox3d box = sphere.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const double end = plan.frame.origin[axis] + plan.coarseCells[axis] * plan.cubeSize(0);
    EXPECT_LE(plan.frame.origin[axis], box.min()[axis] - 2 * plan.cubeSize(0));
    EXPECT_GE(end, box.max()[axis] + 2 * plan.cubeSize(0));
  }
}

TEST(Sizing, PlanCapsTheLevelsFromTheFinestDown) {
  const test::AnalyticSphere sphere(Vector3d::Zero(), 10, {.resolution = 0.25});
  SizingOptions options{.edgeLength = 1, .maxEdgeLength = 4, .minEdgeLength = 0.25};
  const auto levels = [&](int cap) {
    options.levels = cap;
    const LatticePlan plan = planLattice(sphere, options);
    EXPECT_DOUBLE_EQ(plan.cubeSize(plan.surfaceLevel), 1) << cap;
    return plan.levels;
  };
  EXPECT_EQ(levels(0), 5);
  for (int cap = 1; cap <= 5; ++cap) EXPECT_EQ(levels(cap), cap);
  EXPECT_EQ(levels(9), 5);
}

TEST(Sizing, SpheresAboveTheResolutionAreNeverMissed) {
  constexpr unsigned seed = 21;
  constexpr double resolution = 1, edge = 2, halfWidth = 12;
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) { return a + (b - a) * double(random()) / 4294967296.0; };
  for (int place = 0; place < 200; ++place) {
    SCOPED_TRACE("seed 21, place " + std::to_string(place));
    const double radius = between(resolution, 2.5), free = halfWidth - radius;
    const double x = between(-free, free), y = between(-free, free), z = between(-free, free);
    // Every other sphere is known only in the band that the mesher asks for.
    const double band = place % 2 == 0 ? kNoBand : 2 * edge;
    const SphereInABox sphere({x, y, z}, radius, halfWidth, {.resolution = resolution, .band = band});
    const Sized s = sized(sphere, {.edgeLength = edge, .maxEdgeLength = 8, .curvature = 0, .thickness = 0});
    int atSurfaceLevel = 0, coarseAtTheSurface = 0;
    for (const LatticeTet& leaf : s.leaves) {
      if (leaf.level == s.plan.surfaceLevel) {
        atSurfaceLevel += changesSign(s, sphere, leaf);
        continue;
      }
      if (std::abs(sphere.exact(s.corners(leaf)[0]).phi) > s.longestEdge(leaf) + edge) continue;
      double nearest = kNoBand;
      forPointsIn(s.corners(leaf), 2,
                  [&](const Vector3d& p) { nearest = std::min(nearest, std::abs(sphere.exact(p).phi)); });
      coarseAtTheSurface += nearest < edge;  // "uniform within one edge length"
    }
    ASSERT_EQ(coarseAtTheSurface, 0);
    ASSERT_GT(atSurfaceLevel, 0);
  }
}

TEST(Sizing, CubesAtTheSurfaceHaveTheEdgeLength) {
  const test::AnalyticTorus torus({0.3, 0.1, -0.2}, 9, 4);
  for (const double edge : {0.9, 2.0}) {
    const Sized s = sized(torus, {.edgeLength = edge, .maxEdgeLength = 8, .curvature = 0, .thickness = 0});
    int atSurface = 0;
    for (const LatticeTet& leaf : s.leaves) {
      if (!changesSign(s, torus, leaf)) continue;
      ++atSurface;
      ASSERT_FALSE(leaf.green);
      ASSERT_NEAR(s.longestEdge(leaf), edge, 1e-12);
    }
    EXPECT_GT(atSurface, 1000);
  }
}

TEST(Sizing, NothingIsLargerThanTheLargestEdge) {
  const test::AnalyticSphere sphere(Vector3d::Zero(), 9);
  for (const double largest : {1.0, 1.9, 2.0, 3.9, 4.0}) {
    const Sized s =
        sized(sphere, {.edgeLength = 1, .maxEdgeLength = largest, .curvature = 0, .thickness = 0});
    double longest = 0;
    for (const LatticeTet& leaf : s.leaves)
      if (sphere.value(s.corners(leaf)[0]) < 0) longest = std::max(longest, s.longestEdge(leaf));
    EXPECT_LE(longest, largest + 1e-12);
    EXPECT_GT(2 * longest, largest);  // and the room is used: the sizes are halvings
  }
}

TEST(Sizing, CurvatureRefinesTheInnerRingOfATorus) {
  // |k1| + |k2| is 1/4 + 1/6 on the inner ring, 1/4 + 1/14 on the outer one: 1.04 and 0.80 per cube of 2.5
  // mm.
  const test::AnalyticTorus torus(Vector3d::Zero(), 10, 4, {.resolution = 0.3});
  const SizingOptions options{
      .edgeLength = 2.5, .maxEdgeLength = 10, .minEdgeLength = 0.3, .curvature = 0.92, .thickness = 0};
  const Sized s = sized(torus, options);
  int inner = 0, outer = 0;
  for (const LatticeTet& leaf : s.leaves) {
    if (!changesSign(s, torus, leaf)) continue;
    const auto x = s.corners(leaf);
    const Vector3d c = (x[0] + x[1] + x[2] + x[3]) / 4;
    const double rho = std::hypot(c.x(), c.y());
    if (std::abs(c.z()) > 0.7) continue;
    if (rho < 7) {
      ++inner;
      EXPECT_EQ(leaf.level, s.plan.surfaceLevel + 1);
    } else if (rho > 13) {
      ++outer;
      EXPECT_EQ(leaf.level, s.plan.surfaceLevel);
    }
  }
  EXPECT_GT(inner, 0);
  EXPECT_GT(outer, 0);
}

/// Lowest and highest level of the leaves that the surface passes, from the surface level up.
std::pair<int, int> levelsAtTheSurface(const SignedDistance& phi, const SizingOptions& options) {
  const Sized s = sized(phi, options);
  std::pair<int, int> range{99, -99};
  for (const LatticeTet& leaf : s.leaves) {
    if (!changesSign(s, phi, leaf)) continue;
    const int level = leaf.level - s.asked;
    range = {std::min(range.first, level), std::max(range.second, level)};
  }
  return range;
}

TEST(Sizing, ThinWallsAreRefinedUntilTheyHoldEnoughCubes) {
  const auto shell = [](double thickness) {  // of one thickness everywhere, without a rim
    const AnalyticOptions options{.resolution = 0.2};
    const double outer = 2.5 + thickness;
    return test::AnalyticDifference(std::make_shared<test::AnalyticSphere>(Vector3d::Zero(), outer),
                                    std::make_shared<test::AnalyticSphere>(Vector3d::Zero(), 2.5), options);
  };
  using Levels = std::pair<int, int>;
  SizingOptions options{
      .edgeLength = 1, .maxEdgeLength = 4, .minEdgeLength = 0.2, .curvature = 0, .thickness = 1.6};
  EXPECT_EQ(levelsAtTheSurface(shell(2.5), options), Levels(0, 0));
  EXPECT_EQ(levelsAtTheSurface(shell(1), options), Levels(1, 1));    // 1 mm holds 1.6 cubes of 0.5 mm
  EXPECT_EQ(levelsAtTheSurface(shell(0.5), options), Levels(2, 2));  // and 0.5 mm those of 0.25 mm
  options.minEdgeLength = 0.5;
  EXPECT_EQ(levelsAtTheSurface(shell(0.5), options), Levels(1, 1));
  options.minEdgeLength = 0.2;
  options.thickness = 0;
  EXPECT_EQ(levelsAtTheSurface(shell(0.5), options), Levels(0, 0));
}

TEST(Sizing, OnlyThicknessGoesBelowTheResolution) {
  const SizingOptions strict{.edgeLength = 1,
                             .maxEdgeLength = 4,
                             .minEdgeLength = 0.25,
                             .curvature = 0.01,
                             .tolerance = 1e-6,
                             .thickness = 0};
  using Levels = std::pair<int, int>;
  const test::AnalyticSphere ball(Vector3d::Zero(), 4, {.resolution = 0.5});
  EXPECT_EQ(levelsAtTheSurface(ball, strict), Levels(1, 1));
  const test::AnalyticDifference shell(std::make_shared<test::AnalyticSphere>(Vector3d::Zero(), 4.4),
                                       std::make_shared<test::AnalyticSphere>(Vector3d::Zero(), 4),
                                       AnalyticOptions{.resolution = 0.5});
  SizingOptions thin = strict;
  thin.thickness = 1.6;
  EXPECT_EQ(levelsAtTheSurface(shell, thin), Levels(2, 2));
}

TEST(Sizing, BelowTheResolutionRidgesAreNoThinParts) {
  const SizingOptions options{
      .edgeLength = 1, .maxEdgeLength = 4, .minEdgeLength = 0.25, .curvature = 0, .thickness = 1.6};
  using Levels = std::pair<int, int>;
  const AnalyticOptions sampled{.resolution = 0.5};
  const test::AnalyticBox block(Vector3d::Constant(-1.7), Vector3d::Constant(1.7), sampled);
  EXPECT_EQ(levelsAtTheSurface(block, options), Levels(1, 1)) << "its edges and corners reach 0.5 mm";
  const test::AnalyticBox plate(Vector3d(-3, -3, -0.35), Vector3d(3, 3, 0.35), sampled);
  EXPECT_EQ(levelsAtTheSurface(plate, options).second, 2);
}

TEST(Sizing, ASurfaceThatAsksInManyPlacesIsRefinedAsAWhole) {
  // Edges and corners take up most of a small box, little of a large one.
  const SizingOptions options{
      .edgeLength = 1, .maxEdgeLength = 4, .minEdgeLength = 0.5, .curvature = 0, .thickness = 1.6};
  const AnalyticOptions sampled{.resolution = 0.5};
  const test::AnalyticBox small(Vector3d::Constant(-1.7), Vector3d::Constant(1.7), sampled),
      large(Vector3d::Constant(-16.2), Vector3d::Constant(16.2), sampled);
  using Levels = std::pair<int, int>;
  EXPECT_EQ(levelsAtTheSurface(small, options), Levels(1, 1));
  EXPECT_EQ(levelsAtTheSurface(large, options), Levels(0, 1));
}

TEST(Sizing, ToleranceBoundsTheSagOfAnEdge) {
  // h^2 k / 8 on a sphere of radius 8 mm: 0.0625, 0.0156 and 0.0039 mm for cubes of 2, 1 and 0.5 mm.
  const test::AnalyticSphere sphere(Vector3d::Zero(), 8, {.resolution = 0.1});
  SizingOptions options{
      .edgeLength = 2, .maxEdgeLength = 4, .minEdgeLength = 0.5, .curvature = 0, .thickness = 0};
  const auto levelsWithin = [&](double tolerance) {
    options.tolerance = tolerance;
    return levelsAtTheSurface(sphere, options);
  };
  using Levels = std::pair<int, int>;
  EXPECT_EQ(levelsWithin(0), Levels(0, 0));
  EXPECT_EQ(levelsWithin(0.07), Levels(0, 0));
  EXPECT_EQ(levelsWithin(0.05), Levels(1, 1));
  EXPECT_EQ(levelsWithin(0.01), Levels(2, 2));
  EXPECT_EQ(levelsWithin(0.0001), Levels(2, 2)) << "minEdgeLength";
}

TEST(Sizing, LevelsOptionCapsTheRefinement) {
  const test::AnalyticTorus torus(Vector3d::Zero(), 5, 1, {.resolution = 0.1});
  SizingOptions options{.edgeLength = 1, .maxEdgeLength = 2, .minEdgeLength = 0.1};
  const auto finest = [&](int cap) {
    options.levels = cap;
    const Sized s = sized(torus, options);
    int level = 0;
    for (const LatticeTet& leaf : s.leaves) level = std::max(level, leaf.level);
    EXPECT_LE(s.lattice.levels(), cap == 0 ? 99 : cap);
    return level - s.asked;
  };
  EXPECT_EQ(finest(1), 0);
  EXPECT_EQ(finest(2), 0);
  EXPECT_EQ(finest(3), 1);
  EXPECT_GE(finest(0), 1);
}

TEST(Sizing, TheSameForAnyNumberOfThreads) {
  const test::AnalyticTorus torus({0.3, 0.1, -0.2}, 8, 2, {.resolution = 0.3, .band = 2});
  const SizingOptions options{.edgeLength = 1, .maxEdgeLength = 4, .minEdgeLength = 0.3};
  const auto withThreads = [&](std::size_t count) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
    return sized(torus, options).lattice.nodes().nodes();
  };
  const std::vector<Int3> one = withThreads(1);
  EXPECT_GT(one.size(), 1000u);
  EXPECT_EQ(withThreads(4), one);
}

}  // namespace
}  // namespace sinew
