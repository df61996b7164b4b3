#include "Sampling.h"
#include "SolidShapes.h"
#include "sinew/LevelSet/LevelSetFromTriangles.h"
#include "sinew/LevelSet/LevelSetGrid.h"
#include "sinew/LevelSet/LevelSetMeasures.h"
#include "sinew/TestSupport/AnalyticDistance.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

struct Triangles {
  std::vector<Vector3d> nodes;
  std::vector<std::array<std::int32_t, 3>> triangles;
  TriangleSurface surface() const { return {nodes, triangles}; }
};

/// Two triangles on each face of a box, turned outwards.
Triangles boxOf(const Vector3d& lower, const Vector3d& upper) {
  Triangles box;
  for (int corner = 0; corner < 8; ++corner)
    box.nodes.emplace_back(corner & 1 ? upper.x() : lower.x(), corner & 2 ? upper.y() : lower.y(),
                           corner & 4 ? upper.z() : lower.z());
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

/// An octahedron whose triangles are cut in four `times` times, its nodes on the sphere.
Triangles sphereOf(const Vector3d& centre, double radius, int times) {
  Triangles sphere;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1., -1.}) sphere.nodes.push_back(side * Vector3d::Unit(axis));
  sphere.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int n = 0; n < times; ++n) {
    std::map<std::pair<int, int>, std::int32_t> known;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] = known.try_emplace(std::minmax(a, b), std::ssize(sphere.nodes));
      if (fresh) sphere.nodes.push_back((sphere.nodes[a] + sphere.nodes[b]).normalized());
      return at->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sphere.triangles = finer;
  }
  for (Vector3d& node : sphere.nodes) node = centre + radius * node;
  return sphere;
}

Triangles turned(Triangles surface) {
  for (auto& [a, b, c] : surface.triangles) std::swap(b, c);
  return surface;
}

Triangles together(Triangles a, const Triangles& b) {
  const auto first = static_cast<std::int32_t>(a.nodes.size());
  a.nodes.insert(a.nodes.end(), b.nodes.begin(), b.nodes.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + first, j + first, k + first});
  return a;
}

/// Calls check(x, phi) at every sample of the narrow band.
template <class Check>
void forEachSample(const LevelSet& levelSet, Check&& check) {
  const openvdb::FloatGrid& grid = *levelSet.grid->grid;
  for (auto it = grid.cbeginValueOn(); it; ++it) {
    const openvdb::Coord i = it.getCoord();
    check(levelSet.frame * (levelSet.voxelSize * Vector3d(i.x(), i.y(), i.z())), *it);
  }
}

double valueAt(const LevelSet& levelSet, const Vector3d& x) {
  const openvdb::FloatGrid& grid = *levelSet.grid->grid;
  return grid.tree().getValue(openvdb::Coord::round(grid.worldToIndex({x.x(), x.y(), x.z()})));
}

const Vector3d kLower(-3.1, 2.2, 10.3), kUpper(4.2, 7.7, 16.1);
constexpr double kSpacing = 0.25;

TEST(LevelSetFromTriangles, TheDistanceToABoxIsExact) {
  LevelSetFromTrianglesReport report;
  const Triangles box = boxOf(kLower, kUpper);
  const LevelSet levelSet = levelSetFromTriangles(box.surface(), {.spacing = kSpacing}, &report);
  const test::AnalyticBox exact(kLower, kUpper);
  constexpr double kRounding = 1e-5;  // of single precision, at distances of a few mm
  std::int64_t samples = 0;
  forEachSample(levelSet, [&](const Vector3d& x, double phi) {
    ASSERT_NEAR(phi, exact.value(x), kRounding);
    ++samples;
  });
  // Eight voxels across the surface of 230 mm^2.
  EXPECT_NEAR(static_cast<double>(samples), 8 * 230 / (kSpacing * kSpacing), 0.15 * samples);
  EXPECT_EQ(levelSet.voxelSize, kSpacing);
  EXPECT_EQ(levelSet.band, 4 * kSpacing);
  EXPECT_LT(valueAt(levelSet, (kLower + kUpper) / 2), 0);
  EXPECT_GT(valueAt(levelSet, kUpper + Vector3d(1, 1, 1)), 0);
  const Vector3d sides = kUpper - kLower;
  EXPECT_NEAR(report.surfaceVolume, sides.prod(), 1e-9 * sides.prod());
  EXPECT_NEAR(report.levelSetVolume, sides.prod(), 0.002 * sides.prod());  // edges, half a voxel in 20
  EXPECT_EQ(report.solids, 1);
  EXPECT_EQ(report.cavities, 0);
}

TEST(LevelSetFromTriangles, NothingIsLeftOutsideOfTheBoxOfTheGrid) {
  const LevelSet levelSet = levelSetFromTriangles(boxOf(kLower, kUpper).surface(), {.spacing = kSpacing});
  const openvdb::CoordBBox active = levelSet.grid->grid->evalActiveVoxelBoundingBox();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(levelSet.lower[axis], active.min()[axis]);
    EXPECT_GT(levelSet.upper[axis], active.max()[axis]);
  }
  const openvdb::Vec3d first = levelSet.grid->grid->indexToWorld(openvdb::Coord(0, 0, 0));
  EXPECT_EQ(Vector3d(first.x(), first.y(), first.z()), levelSet.frame.translation());
}

TEST(LevelSetFromTriangles, ASphereOfTrianglesIsASphere) {
  constexpr double radius = 6;
  const Vector3d centre(1, -20, 300);
  const Triangles sphere = sphereOf(centre, radius, 4);
  LevelSetFromTrianglesReport report;
  const LevelSet levelSet = levelSetFromTriangles(sphere.surface(), {}, &report);
  EXPECT_DOUBLE_EQ(levelSet.voxelSize, 2 * radius / 200);
  // The triangles hold a ball that is smaller by how far their planes cut into the sphere.
  double sag = 0;
  for (const auto& [a, b, c] : sphere.triangles) {
    const Vector3d &A = sphere.nodes[a], &B = sphere.nodes[b], &C = sphere.nodes[c];
    sag = std::max(sag, radius - (B - A).cross(C - A).normalized().dot(A - centre));
  }
  EXPECT_LT(sag, 0.03);
  // Deeper in the band OpenVDB asks only the triangles that it found nearer to the surface.
  const auto allowed = [&](double phi) {
    return std::abs(phi) < 1.5 * levelSet.voxelSize ? 1e-4 : 0.1 * levelSet.voxelSize;
  };
  forEachSample(levelSet, [&](const Vector3d& x, double phi) {
    const double exact = (x - centre).norm() - radius;
    ASSERT_GE(phi, exact - allowed(phi));
    ASSERT_LE(phi, exact + sag + allowed(phi));
  });
  EXPECT_NEAR(report.levelSetVolume, report.surfaceVolume, 1e-4 * report.surfaceVolume);
  const LevelSetTopology topology = levelSetTopology(levelSet);
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.eulerCharacteristic, 2);
}

TEST(LevelSetFromTriangles, ASurfaceTurnedInwardsHoldsTheSameShape) {
  const Triangles box = boxOf(kLower, kUpper);
  const LevelSet levelSet = levelSetFromTriangles(turned(box).surface(), {.spacing = kSpacing});
  const test::AnalyticBox exact(kLower, kUpper);
  forEachSample(levelSet, [&](const Vector3d& x, double phi) { ASSERT_NEAR(phi, exact.value(x), 1e-5); });
}

TEST(LevelSetFromTriangles, SurfacesAddUpAndThoseTurnedAgainstThemAreCavities) {
  const Vector3d centre(0, 0, 0);
  const Triangles outer = sphereOf(centre, 6, 4), inner = sphereOf(centre, 3, 4);
  const Triangles beside = boxOf(Vector3d(8, -1, -1), Vector3d(10, 1, 1));
  const Triangles all = together(together(turned(inner), outer), beside);
  LevelSetFromTrianglesReport report;
  const LevelSet levelSet = levelSetFromTriangles(all.surface(), {.spacing = 0.2}, &report);
  EXPECT_EQ(report.solids, 2);
  EXPECT_EQ(report.cavities, 1);
  EXPECT_NEAR(report.levelSetVolume, report.surfaceVolume, 2e-3 * report.surfaceVolume);
  EXPECT_GT(valueAt(levelSet, centre), 0);
  EXPECT_LT(valueAt(levelSet, {4.5, 0, 0}), 0);
  EXPECT_GT(valueAt(levelSet, {7, 0, 0}), 0);
  EXPECT_LT(valueAt(levelSet, {9, 0, 0}), 0);
  const LevelSetTopology topology = levelSetTopology(levelSet);
  EXPECT_EQ(topology.components, 2);
  EXPECT_EQ(topology.eulerCharacteristic, 6);
}

TEST(LevelSetFromTriangles, ASolidInACavityInASolidIsThere) {
  const Vector3d centre(0, 0, 0);
  const Triangles outer = sphereOf(centre, 8, 4), hollow = turned(sphereOf(centre, 5, 4)),
                  core = sphereOf(centre, 2, 4);
  for (const Triangles& all :
       {together(core, together(hollow, outer)), together(outer, together(hollow, core))}) {
    LevelSetFromTrianglesReport report;
    const LevelSet levelSet = levelSetFromTriangles(all.surface(), {.spacing = 0.3}, &report);
    EXPECT_EQ(report.solids, 2);
    EXPECT_EQ(report.cavities, 1);
    EXPECT_LT(valueAt(levelSet, centre), 0);
    EXPECT_GT(valueAt(levelSet, {3.5, 0, 0}), 0);
    EXPECT_LT(valueAt(levelSet, {6.5, 0, 0}), 0);
    EXPECT_NEAR(report.levelSetVolume, report.surfaceVolume, 5e-3 * report.surfaceVolume);
    EXPECT_EQ(levelSetTopology(levelSet).components, 2);
  }
}

TEST(LevelSetFromTriangles, OnALatticeItHasTheSamplesOfTheLattice) {
  const SampleLattice lattice = test::tiltedLattice(kSpacing);
  const Triangles box = boxOf(kLower, kUpper);
  const test::AnalyticBox exact(kLower, kUpper);
  for (const double band : {0.5, 0.75, 1.5}) {
    LevelSetFromTrianglesReport report;
    const DenseLevelSet levelSet = levelSetFromTriangles(box.surface(), lattice, band, &report);
    EXPECT_TRUE(firstSampleOn(lattice, levelSet).has_value());
    EXPECT_EQ(levelSet.band, band);
    EXPECT_EQ(report.solids, 1);
    test::forEachSample(levelSet, [&](const Vector3d& x, double phi) {
      const double allowed = std::abs(exact.value(x)) < kSpacing ? 1e-5 : 0.5 * kSpacing;  // marched
      ASSERT_NEAR(phi, std::clamp(exact.value(x), -band, band), allowed);
    });
    EXPECT_NEAR(test::volumeOf(levelSet), (kUpper - kLower).prod(), 0.005 * (kUpper - kLower).prod());
  }
  EXPECT_THROW(levelSetFromTriangles(box.surface(), lattice, 0), std::invalid_argument);
  EXPECT_THROW(levelSetFromTriangles(box.surface(), lattice, 101 * kSpacing), std::invalid_argument);
  EXPECT_THROW(levelSetFromTriangles(box.surface(), test::tiltedLattice(1e-4), 3e-4), std::invalid_argument);
}

TEST(LevelSetFromTriangles, TheSameGridForAnyNumberOfThreads) {
  const Triangles sphere = sphereOf({0.1, 0.2, 0.3}, 5, 4);
  const auto valuesOf = [&](int threads) {
    return test::onThreads(threads, [&] {
      std::vector<double> values;
      forEachSample(levelSetFromTriangles(sphere.surface(), {.spacing = 0.1}),
                    [&](const Vector3d& x, double phi) {
                      values.insert(values.end(), {x.sum(), phi});
                    });
      return values;
    });
  };
  const std::vector<double> one = valuesOf(1);
  EXPECT_GT(one.size(), 100000u);
  for (const int threads : {2, 4, 4}) EXPECT_EQ(valuesOf(threads), one) << threads;
}

TEST(LevelSetFromTriangles, WhatIsNoClosedManifoldIsRefusedInOneLine) {
  struct Case {
    const char* message;
    void (*spoil)(Triangles&);
  };
  const std::vector<Case> cases{
      {"there are no triangles", [](Triangles& s) { s.triangles.clear(); }},
      {"3 edges with one triangle (the surface is open)", [](Triangles& s) { s.triangles.pop_back(); }},
      {"3 edges with more than two triangles", [](Triangles& s) { s.triangles.push_back(s.triangles[0]); }},
      {"3 edges between triangles turned against each other",
       [](Triangles& s) { std::swap(s.triangles[4][0], s.triangles[4][1]); }},
      {"triangle 2 names node 8, which is not there", [](Triangles& s) { s.triangles[2][1] = 8; }},
      {"triangle 2 names node -1, which is not there", [](Triangles& s) { s.triangles[2][1] = -1; }},
      {"triangle 2 names a node twice", [](Triangles& s) { s.triangles[2][1] = s.triangles[2][0]; }},
      {"node 5 has no finite coordinates", [](Triangles& s) { s.nodes[5].y() = std::nan(""); }},
      {"the surface has no volume", [](Triangles& s) {
         for (Vector3d& node : s.nodes) node.z() = 1;
       }}};
  for (const Case& c : cases) {
    Triangles box = boxOf(kLower, kUpper);
    c.spoil(box);
    const std::string message = test::messageOf<std::invalid_argument>(
        [&] { levelSetFromTriangles(box.surface(), {.spacing = kSpacing}); });
    EXPECT_NE(message.find(c.message), std::string::npos) << c.message << " against " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(LevelSetFromTriangles, RefusesOptionsOutOfRange) {
  const Triangles box = boxOf(kLower, kUpper);
  for (const LevelSetFromTrianglesOptions& options : std::vector<LevelSetFromTrianglesOptions>{
           {.spacing = -1}, {.spacing = std::nan("")}, {.spacing = 1e-9}, {.bandVoxels = 2}})
    EXPECT_THROW(levelSetFromTriangles(box.surface(), options), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
