#include "Sampling.h"
#include "SolidShapes.h"
#include "sinew/LevelSet/Csg.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::sampled;
using test::volumeOf;

using std::numbers::pi;
constexpr double kBand = 4;

/// Two level sets on a box that holds both, to compare them sample by sample.
std::pair<DenseField, DenseField> aligned(const DenseLevelSet& a, const DenseLevelSet& b) {
  const Vector3i shift = firstSampleOn({a.frame, a.voxelSize}, b).value();
  const Vector3i lower = shift.cwiseMin(0),
                 upper = (shift + b.phi.size).cwiseMax(a.phi.size) - Vector3i::Ones();
  return {onBox(a, lower, upper).phi, onBox(b, lower - shift, upper - shift).phi};
}

void expectSame(const DenseLevelSet& a, const DenseLevelSet& b) {
  const auto [x, y] = aligned(a, b);
  EXPECT_EQ(x.values, y.values);
  EXPECT_EQ(a.band, b.band);
}

/// A few shapes that cross, in random places.
struct RandomShapes {
  explicit RandomShapes(unsigned seed) : random(seed) {}
  std::mt19937 random;
  DenseLevelSet next() {
    const Vector3d x = test::pointIn(random, 5), y = test::pointIn(random, 9);
    switch (random() % 4) {
      case 0:
        return sampled(sphere(x, 7));
      case 1:
        return sampled(box(x - Vector3d(4, 6, 8), x + Vector3d(5, 6, 3)));
      case 2:
        return sampled(torus(x, y, 8, 3));
      default:
        return sampled(capsule(x, y, 4));
    }
  }
};

class CsgLaws : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, CsgLaws, testing::Values(1, 2, 3, 4, 5));  // the seed is the test's name

TEST_P(CsgLaws, TheSetAlgebraHoldsBitForBit) {
  RandomShapes shapes(GetParam());
  const DenseLevelSet a = shapes.next(), b = shapes.next(), c = shapes.next();
  expectSame(unite(a, a), a);
  expectSame(intersect(a, a), a);
  expectSame(unite(a, b), unite(b, a));
  expectSame(intersect(a, b), intersect(b, a));
  expectSame(unite(unite(a, b), c), unite(a, unite(b, c)));
  expectSame(intersect(a, unite(b, c)), unite(intersect(a, b), intersect(a, c)));
  // De Morgan, with a for the whole:  a - (b + c) = (a - b) * (a - c),  a - b * c = (a - b) + (a - c)
  expectSame(subtract(a, unite(b, c)), intersect(subtract(a, b), subtract(a, c)));
  expectSame(subtract(a, intersect(b, c)), unite(subtract(a, b), subtract(a, c)));
}

TEST_P(CsgLaws, WhatIsLeftOfADifferenceIsTheIntersection) {
  RandomShapes shapes(GetParam());
  const DenseLevelSet a = shapes.next(), b = shapes.next();
  // A-(A-B) has the surface of A twice, as max(phi, -phi): a sheet without thickness, no sample below zero.
  const DenseLevelSet twice = subtract(a, subtract(a, b)), both = intersect(a, b);
  const auto [x, y] = aligned(twice, both);
  for (std::size_t n = 0; n < x.values.size(); ++n)
    if (x.values[n] < 0 || y.values[n] < 0) {
      ASSERT_NEAR(x.values[n], y.values[n], 0.1);
    }
}

TEST_P(CsgLaws, VolumesAddUp) {
  RandomShapes shapes(GetParam());
  const DenseLevelSet a = shapes.next(), b = shapes.next();
  const double both = volumeOf(intersect(a, b)), whole = volumeOf(a) + volumeOf(b);
  EXPECT_NEAR(volumeOf(unite(a, b)) + both, whole, 0.005 * whole);
  EXPECT_NEAR(volumeOf(subtract(a, b)) + both, volumeOf(a), 0.005 * volumeOf(a));
}

/// A result and its exact volume.
struct KnownVolume {
  const char* name;
  DenseLevelSet (*make)();
  double (*exact)(const Vector3d&);  ///< zero set and sign of the exact result
  double volume;
};

double distanceTo(const Solid& solid, const Vector3d& x) { return solid.phi(x); }

const Solid kOneBall = sphere({0, 0, 0}, 12), kOther = sphere({10, 0, 0}, 9);
const Solid kDrill = cylinder({0, 0, -20}, {0, 0, 20}, 5);
const Solid kBrick = box({-9, -8, -10}, {9, 8, 10}), kCorner = box({0, 1, 2}, {15, 16, 14});

double lens(double R, double r, double d) {
  return pi * std::pow(R + r - d, 2) * (d * d + 2 * d * (r + R) - 3 * (r - R) * (r - R)) / (12 * d);
}
double ballVolume(double r) { return 4 * pi / 3 * r * r * r; }

const std::vector<KnownVolume> kKnown{
    {"lens", [] { return intersect(sampled(kOneBall), sampled(kOther)); },
     [](const Vector3d& x) { return std::max(distanceTo(kOneBall, x), distanceTo(kOther, x)); },
     lens(12, 9, 10)},
    {"two balls", [] { return unite(sampled(kOneBall), sampled(kOther)); },
     [](const Vector3d& x) { return std::min(distanceTo(kOneBall, x), distanceTo(kOther, x)); },
     ballVolume(12) + ballVolume(9) - lens(12, 9, 10)},
    {"moon", [] { return subtract(sampled(kOneBall), sampled(kOther)); },
     [](const Vector3d& x) { return std::max(distanceTo(kOneBall, x), -distanceTo(kOther, x)); },
     ballVolume(12) - lens(12, 9, 10)},
    {"napkin ring", [] { return subtract(sampled(kOneBall), sampled(kDrill)); },
     [](const Vector3d& x) { return std::max(distanceTo(kOneBall, x), -distanceTo(kDrill, x)); },
     4 * pi / 3 * std::pow(144 - 25, 1.5)},
    {"corner of two boxes", [] { return intersect(sampled(kBrick), sampled(kCorner)); },
     [](const Vector3d& x) { return std::max(distanceTo(kBrick, x), distanceTo(kCorner, x)); }, 9 * 7 * 8},
    {"two boxes", [] { return unite(sampled(kBrick), sampled(kCorner)); },
     [](const Vector3d& x) { return std::min(distanceTo(kBrick, x), distanceTo(kCorner, x)); },
     18 * 16 * 20 + 15 * 15 * 12 - 9 * 7 * 8}};

TEST(Csg, TheSurfaceIsTheExactOneWithinHalfAVoxelAndVolumesWithinHalfAPercent) {
  for (const KnownVolume& known : kKnown) {
    SCOPED_TRACE(known.name);
    const DenseLevelSet result = known.make();
    // min and max are the distance but beyond a crease, where planes at a right angle leave 1/sqrt(2) of it.
    const double allowed = 0.5 / std::sqrt(2.0);
    int crossings = 0;
    test::forEachCrossing(result, [&](const Vector3d& x) {
      ASSERT_LE(std::abs(known.exact(x)), allowed);
      ++crossings;
    });
    EXPECT_GT(crossings, 300);
    // The way back: no sample farther than that from the exact surface is on the wrong side of it.
    test::forEachSample(result, [&](const Vector3d& x, double phi) {
      const double exact = known.exact(x);
      if (std::abs(exact) > allowed) {
        ASSERT_EQ(exact < 0, phi < 0);
      }
    });
    EXPECT_NEAR(volumeOf(result), known.volume, 0.005 * known.volume);
  }
}

TEST(Csg, BoxesHoldWhatIsThereAndNoMore) {
  const DenseLevelSet left = sampled(sphere({-10, 0, 0}, 6)), right = sampled(sphere({10, 0, 0}, 6));
  EXPECT_TRUE((unite(left, right).phi.size.array() >= left.phi.size.array()).all());
  const DenseLevelSet nothing = intersect(left, right),
                      apart = intersect(left, sampled(sphere({90, 0, 0}, 6)));
  for (const DenseLevelSet& empty : {nothing, apart, subtract(left, left)})
    for (const float phi : empty.phi.values) ASSERT_GE(phi, 0);
  const DenseLevelSet small = intersect(sampled(sphere({0, 0, 0}, 20)), sampled(sphere({0, 0, 0}, 4)));
  EXPECT_LE(small.phi.size.maxCoeff(), 2 * (4 + kBand) + 4);
  const DenseLevelSet half =
      subtract(sampled(sphere({0, 0, 0}, 10)), sampled(box({-20, -20, -20}, {20, 20, 8})));
  EXPECT_LT(half.phi.values.size(), sampled(sphere({0, 0, 0}, 10)).phi.values.size() / 2);
}

TEST(Csg, TheBorderIsOutside) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    RandomShapes shapes(seed);
    const DenseLevelSet a = shapes.next(), b = shapes.next();
    for (const DenseLevelSet& result : {unite(a, b, 2), intersect(a, b, 2), subtract(a, b, 2)}) {
      const DenseField& phi = result.phi;
      for (int k = 0; k < phi.size.z(); ++k)
        for (int j = 0; j < phi.size.y(); ++j)
          for (int i = 0; i < phi.size.x(); ++i) {
            const Vector3i at(i, j, k);
            const bool border = (at.array() == 0).any() || (at.array() == phi.size.array() - 1).any();
            ASSERT_TRUE(!border || phi(i, j, k) > 0) << "seed " << seed;
          }
    }
  }
}

/// Two slabs whose upper faces meet in a valley, or a ridge, along y: at x = z = 0, normals at +-angle/2 of
/// z.
struct Wedge {
  double angle;  ///< between the normals
  Vector3d left() const { return {-std::sin(angle / 2), 0, std::cos(angle / 2)}; }
  Vector3d right() const { return {std::sin(angle / 2), 0, std::cos(angle / 2)}; }
  DenseLevelSet slab(const Vector3d& normal) const {
    return sampleSolid(halfSpace({0, 0, 0}, normal), test::tiltedLattice(), kBand,
                       {Vector3d(-14, -14, -14), Vector3d(14, 14, 14)});
  }
};

TEST(Csg, AFilletIsTheCircleThatTouchesBothPlanesAndAnEllipseInASharpValley) {
  constexpr double r = 3;
  for (const double degrees : {20., 40., 90., 130.}) {
    const Wedge wedge{degrees * pi / 180};
    const DenseLevelSet valley = unite(wedge.slab(wedge.left()), wedge.slab(wedge.right()), r);
    const DenseLevelSet ridge = intersect(wedge.slab(wedge.left()), wedge.slab(wedge.right()), r);
    const double centre = r / std::cos(wedge.angle / 2);  // where both planes are r away
    int inFillet = 0;
    const auto check = [&](const DenseLevelSet& result, double side) {
      test::forEachSample(result, [&](const Vector3d& x, double phi) {
        if (x.cwiseAbs().maxCoeff() > 7) return;  // away from where the slabs end
        const double a = side * wedge.left().dot(x), b = side * wedge.right().dot(x);
        const Vector3d d = Vector3d(0, 0, side * centre) - Vector3d(x.x(), 0, x.z());
        const double half = std::atan2(std::abs(d.x()), side * d.z());
        const bool round = side * d.z() > 0 && half < wedge.angle / 2;
        const bool ellipse = degrees > 90 && a < r && b < r;
        const double exact = side * (ellipse                  ? r - std::hypot(r - a, r - b)
                                     : degrees <= 90 && round ? r - d.norm()
                                                              : std::min(a, b));
        if (std::abs(exact) > 2) return;
        inFillet += round || ellipse;
        ASSERT_NEAR(phi, exact, 1e-4) << degrees << " at " << x.transpose();  // single precision
      });
    };
    check(valley, 1);
    check(ridge, -1);
    EXPECT_GT(inFillet, 50);
  }
}

TEST(Csg, ABlendChangesOnlyWhereBothSurfacesAreNearerThanItsRadius) {
  constexpr double r = 3;
  const DenseLevelSet a = sampled(kOneBall), b = sampled(kOther);
  const auto compare = [](const DenseLevelSet& sharp, const DenseLevelSet& blended, double sideA,
                          double sideB) {
    const auto [x, y] = aligned(sharp, blended);
    DenseLevelSet both = sharp;  // on the samples of both
    both.frame =
        sharp.frame * Eigen::Translation3d(
                          sharp.voxelSize *
                          firstSampleOn({sharp.frame, sharp.voxelSize}, blended)->cwiseMin(0).cast<double>());
    both.phi = x;
    std::size_t n = 0;
    int different = 0;
    test::forEachSample(both, [&](const Vector3d& at, double phi) {
      const double blendedPhi = y.values[n++];
      if (phi == blendedPhi) return;
      ++different;
      ASSERT_LT(sideA * kOneBall.phi(at), r + 1e-4);  // single precision
      ASSERT_LT(sideB * kOther.phi(at), r + 1e-4);
    });
    EXPECT_GT(different, 100);
  };
  compare(unite(a, b), unite(a, b, r), 1, 1);
  compare(intersect(a, b), intersect(a, b, r), -1, -1);
  compare(subtract(a, b), subtract(a, b, r), -1, 1);
}

TEST(Csg, ABlendAddsToAUnionAndTakesFromTheOthers) {
  const DenseLevelSet a = sampled(kBrick), b = sampled(kCorner);
  // Square valleys and ridges, dozens of mm of them, r^2 (1 - pi/4) = 2 mm^2 thick.
  EXPECT_GT(volumeOf(unite(a, b, 3)), volumeOf(unite(a, b)) + 50);
  EXPECT_LT(volumeOf(intersect(a, b, 3)), volumeOf(intersect(a, b)) - 20);
  EXPECT_LT(volumeOf(subtract(a, b, 3)), volumeOf(subtract(a, b)) - 20);
}

TEST(Csg, AShapeBlendedWithItselfIsItself) {
  const DenseLevelSet a = sampled(torus({0, 0, 0}, {1, 1, 3}, 9, 4));
  for (const DenseLevelSet& same : {unite(a, a, 3), intersect(a, a, 3)}) {
    const auto [x, y] = aligned(a, same);
    for (std::size_t n = 0; n < x.values.size(); ++n) ASSERT_NEAR(x.values[n], y.values[n], 1e-5);
  }
}

TEST(Csg, TheNumberOfThreadsDoesNotShow) {
  const DenseLevelSet a = sampled(kOneBall), b = sampled(kOther);
  for (const double blend : {0., 2.}) {
    const auto run = [&] { return unite(subtract(a, b, blend), intersect(a, b, blend), blend).phi.values; };
    EXPECT_EQ(test::onThreads(1, run), test::onThreads(4, run));
  }
}

TEST(Csg, RefusesOtherLatticesAndBlendsOutOfRange) {
  const DenseLevelSet a = sampled(kOneBall);
  const auto message = [&](const DenseLevelSet& b, double blend) {
    return test::messageOf<std::invalid_argument>([&] { unite(a, b, blend); });
  };
  const std::string lattice = "unite: the two level sets have not the same lattice";
  EXPECT_EQ(message(sampled(kOneBall, kBand, test::tiltedLattice(0.9)), 0), lattice);
  EXPECT_EQ(message(sampled(kOneBall, kBand, {}), 0), lattice);
  EXPECT_EQ(message(a, -1), "unite: blend must lie in [0, 4.000000], the band in mm, got -1.000000");
  EXPECT_EQ(message(a, 4.5), "unite: blend must lie in [0, 4.000000], the band in mm, got 4.500000");
  EXPECT_THROW(intersect(a, a, std::nan("")), std::invalid_argument);
  EXPECT_THROW(subtract(a, a, 5), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
