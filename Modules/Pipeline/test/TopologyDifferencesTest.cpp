#include "SampledLevelSet.h"
#include "TopologyDifferences.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <random>

namespace sinew {
namespace {

using Distance = std::function<double(const Eigen::Vector3d&)>;
using enum TopologyChange;

constexpr int kReach = 18;        // samples from the origin to the box
constexpr double kSample = 0.5;   // mm
const Eigen::Isometry3d kFrame =  // the level set's frame is turned against LPS, as for a tilted scan
    Eigen::Translation3d(10, -20, 30) * Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized());

// ---- distances in samples ----

Distance ball(const Eigen::Vector3d& centre, double radius) {
  return [=](const Eigen::Vector3d& x) { return (x - centre).norm() - radius; };
}
/// Around the z axis.
Distance torus(double centreLine, double radius) {
  return [=](const Eigen::Vector3d& x) {
    return std::hypot(std::hypot(x.x(), x.y()) - centreLine, x.z()) - radius;
  };
}
/// Along x, from -length to length, thicker towards its ends.
Distance waisted(double length, double radius) {
  return [=](const Eigen::Vector3d& x) {
    const double ends = std::abs(x.x()) - length;
    return std::max(std::hypot(x.y(), x.z()) - radius - std::abs(x.x()) / 8, ends);
  };
}
Distance operator|(Distance a, Distance b) {
  return [=](const Eigen::Vector3d& x) { return std::min(a(x), b(x)); };
}
Distance operator-(Distance a, Distance b) {
  return [=](const Eigen::Vector3d& x) { return std::max(a(x), -b(x)); };
}

/// A mesh that holds those samples with phi < 0 and no others: cubes around them, of six tets each.
TetMesh cubesWhere(const Distance& phi) {
  TetMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto corner = [&](int x, int y, int z) {
    const auto [entry, isNew] = numbers.try_emplace({x, y, z}, static_cast<std::int32_t>(numbers.size()));
    if (isNew) mesh.nodes.push_back(kFrame * (kSample * (Eigen::Vector3d(x, y, z).array() - 0.5).matrix()));
    return entry->second;
  };
  for (int x = -kReach; x <= kReach; ++x)
    for (int y = -kReach; y <= kReach; ++y)
      for (int z = -kReach; z <= kReach; ++z) {
        if (!(phi(Eigen::Vector3d(x, y, z)) < 0)) continue;
        for (const auto& [a, b] : {std::pair{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}) {
          const auto at = [&](int c) { return corner(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)); };
          mesh.tets.push_back({at(0), at(a), at(b), at(7)});
        }
      }
  mesh.labels.assign(mesh.tets.size(), 1);
  return mesh;
}

DenseLevelSet levelSetOf(const Distance& phi) {
  return test::sampled(phi, Eigen::Vector3i::Constant(-kReach), Eigen::Vector3i::Constant(kReach), kSample);
}
LevelSetSurface surfaceOf(const Distance& phi) { return LevelSetSurface(levelSetOf(phi)); }

std::vector<TopologyDifference> differences(const Distance& mesh, const Distance& shape) {
  const DenseLevelSet levelSet = levelSetOf(shape);
  return topologyDifferences(cubesWhere(mesh), LevelSetSurface(levelSet), kFrame * levelSet.frame);
}

struct Case {
  const char* name;
  TopologyChange change;
  Distance mesh, shape;
  Eigen::Vector3d place;  ///< samples
  double width;           ///< samples
};

const Distance kDumbbell = ball({-9, 0, 0}, 6) | ball({9, 0, 0}, 6);
const Distance kShell = ball({0, 0, 0}, 11) - ball({0, 0, 0}, 7);
const Distance kApart = ball({-8, 0, 0}, 7) | ball({8, 0, 0}, 7);
const Distance kRing = torus(9, 6.5);  // a hole 5 wide

const std::vector<Case>& cases() {
  static const std::vector<Case> cases{
      {"a neck", BridgeLost, kDumbbell, kDumbbell | waisted(9, 2), {0, 0, 0}, 4},
      {"a filled hole", HoleClosed, kRing | ball({0, 0, 0}, 4), kRing, {0, 0, 0}, 5},
      {"a hole in a shell", SheetPierced, kShell - ball({0, 0, 9}, 3), kShell, {0, 0, 9}, 4},
      {"touching balls", GapClosed, kApart | waisted(3, 3), kApart, {0, 0, 0}, 2},
      {"a speck", PieceLost, ball({-5, 0, 0}, 8), ball({-5, 0, 0}, 8) | ball({12, 0, 0}, 3), {12, 0, 0}, 6},
      {"a bubble", VoidClosed, ball({0, 0, 0}, 12), ball({0, 0, 0}, 12) - ball({2, 0, 0}, 3), {2, 0, 0}, 6},
      // These shrink to a sample.
      {"a new speck",
       PieceAdded,
       ball({-5, 0, 0}, 8) | ball({5.5, 0, 0}, 1.5),
       ball({-5, 0, 0}, 8),
       {5.5, 0, 0},
       3},
      {"a new bubble",
       VoidOpened,
       ball({0, 0, 0}, 8) - ball({5, 0, 0}, 1.5),
       ball({0, 0, 0}, 8),
       {5, 0, 0},
       5}};
  return cases;
}

TEST(TopologyDifferences, EveryKindIsFoundAtItsPlace) {
  for (const Case& c : cases()) {
    const auto found = differences(c.mesh, c.shape);
    ASSERT_EQ(found.size(), 1u) << c.name;
    EXPECT_EQ(found[0].change, c.change) << c.name << ": " << toString(found[0].change);
    // Specks and holes are up to 3 samples in radius; anywhere in them will do.
    const Eigen::Vector3d place = kFrame.inverse() * found[0].place / kSample;
    EXPECT_LT((place - c.place).norm(), 3) << c.name << ": " << place.transpose();
    EXPECT_NEAR(found[0].width / kSample, c.width, 2) << c.name;
  }
}

TEST(TopologyDifferences, ThinningAndThickeningAreNone) {
  const std::vector<Distance> shapes{kDumbbell | waisted(9, 4), kRing, kShell, ball({0, 0, 0}, 9)};
  for (const Distance& shape : shapes)
    for (const double offset : {-0.8, 0., 0.8})
      EXPECT_TRUE(differences([&](const auto& x) { return shape(x) - offset; }, shape).empty()) << offset;
}

TEST(TopologyDifferences, VolumesAreThoseOfTheSamples) {
  const Distance speck = ball({12, 0, 0}, 3);
  const auto found = differences(ball({-5, 0, 0}, 8), ball({-5, 0, 0}, 8) | speck);
  ASSERT_EQ(found.size(), 1u);
  int samples = 0;
  for (int x = -kReach; x <= kReach; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int z = -4; z <= 4; ++z) samples += speck(Eigen::Vector3d(x, y, z)) < 0;
  EXPECT_DOUBLE_EQ(found[0].volume, samples * kSample * kSample * kSample);
}

/// Of a sum of waves, with a margin around it.
Distance waves(int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<std::pair<Eigen::Vector3d, double>> terms;
  for (int k = 0; k < 12; ++k)
    terms.push_back(
        {Eigen::Vector3d(uniform(random), uniform(random), uniform(random)), 3 * uniform(random)});
  return [terms](const Eigen::Vector3d& x) {
    double sum = 0.3;
    for (const auto& [wave, phase] : terms) sum += std::sin(wave.dot(x) + phase);
    return std::max(sum / 2, x.cwiseAbs().maxCoeff() - (kReach - 3));
  };
}

TEST(TopologyDifferences, AccountForTheCountsOfRandomShapes) {
  int total = 0;
  for (int seed = 0; seed < 6; ++seed) {
    const Distance shape = waves(seed), mesh = [&](const Eigen::Vector3d&x) { return shape(x) - 0.25; };
    const LevelSetTopology before = levelSetTopology(surfaceOf(mesh)),
                           after = levelSetTopology(surfaceOf(shape));
    std::int64_t euler = before.eulerCharacteristic;
    const auto found = differences(mesh, shape);
    for (const TopologyDifference& difference : found) euler += difference.euler;
    EXPECT_EQ(euler, after.eulerCharacteristic) << "seed " << seed;
    EXPECT_TRUE(std::ranges::is_sorted(found, std::greater<>(), &TopologyDifference::width));
    total += static_cast<int>(found.size());
  }
  EXPECT_GT(total, 50) << "these shapes are no test";
}

TEST(TopologyDifferences, DoNotDependOnTheNumberOfThreads) {
  const Distance shape = waves(3), mesh = [&](const Eigen::Vector3d&x) { return shape(x) - 0.25; };
  std::vector<Eigen::Vector3d> first;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<Eigen::Vector3d> places;
    for (const TopologyDifference& difference : differences(mesh, shape)) places.push_back(difference.place);
    if (first.empty()) first = places;
    EXPECT_TRUE(places == first) << threads << " threads";
  }
}

}  // namespace
}  // namespace sinew
