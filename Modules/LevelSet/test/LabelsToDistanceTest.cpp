// How true the level sets of voxels are: shapes at random positions and tilts, against their exact distance.
#include "Sampling.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/LevelSet/ShapeMeasures.h"
#include "sinew/LevelSet/Smooth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr unsigned kSeed = 5;
constexpr int kPlaces = 8;
constexpr double kDegrees = 180 / std::numbers::pi;

/// A shape in its own coordinates.
struct Shape {
  std::function<double(const Vector3d&)> distance;
  std::function<Vector3d(const Vector3d&)> normal;  ///< not of unit length
  std::function<bool(const Vector3d&)> measured;    ///< away from rims and ends
  double volume;
};

const Shape kBall{[](const Vector3d& x) { return x.norm() - 20; }, [](const Vector3d& x) { return x; },
                  [](const Vector3d&) { return true; }, 4.0 / 3 * std::numbers::pi * 8000};
const Shape kPlate{[](const Vector3d& x) {
                     return std::max({std::abs(x.z()) - 1.5, std::abs(x.x()) - 14, std::abs(x.y()) - 14});
                   },
                   [](const Vector3d& x) { return Vector3d(0, 0, x.z()); },
                   [](const Vector3d& x) { return x.head<2>().cwiseAbs().maxCoeff() < 11; }, 3.0 * 28 * 28};
const Shape kTube{[](const Vector3d& x) { return std::max(x.head<2>().norm() - 1, std::abs(x.z()) - 15); },
                  [](const Vector3d& x) { return Vector3d(x.x(), x.y(), 0); },
                  [](const Vector3d& x) { return std::abs(x.z()) < 12; }, 30 * std::numbers::pi};

/// Where a shape lies: x in LPS = turn * (x of the shape) + centre.
struct Place {
  Eigen::Matrix3d turn;
  Vector3d centre;

  Vector3d own(const Vector3d& x) const { return turn.transpose() * (x - centre); }
};

Place randomPlace(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  const Vector3d centre = 0.5 * Vector3d(u(random), u(random), u(random));
  const Eigen::Quaterniond turn(u(random), u(random), u(random), u(random));
  return {turn.normalized().toRotationMatrix(), centre};
}

Segmentation voxels(const Shape& shape, const Place& place, const ImageGeometry& geometry) {
  return test::segmentationOf(geometry, [&](const Vector3d& x) { return shape.distance(place.own(x)); });
}

struct Truth {
  double rms = 0;         ///< of phi against the distance, beside the surface, in samples
  double normalMean = 0;  ///< degrees
  double normalRms = 0;   ///< degrees
};

Truth truthOf(const DenseLevelSet& levelSet, const Shape& shape, const Place& place) {
  Truth truth;
  int count = 0;
  const DenseField& phi = levelSet.phi;
  for (int k = 1; k < phi.size.z() - 1; ++k)
    for (int j = 1; j < phi.size.y() - 1; ++j)
      for (int i = 1; i < phi.size.x() - 1; ++i) {
        const Vector3d x = place.own(levelSet.frame * (levelSet.voxelSize * Vector3d(i, j, k)));
        if (std::abs(phi(i, j, k)) > 0.5 * levelSet.voxelSize || !shape.measured(x)) continue;
        const double miss = (phi(i, j, k) - shape.distance(x)) / levelSet.voxelSize;
        const Vector3d gradient(phi(i + 1, j, k) - phi(i - 1, j, k), phi(i, j + 1, k) - phi(i, j - 1, k),
                                phi(i, j, k + 1) - phi(i, j, k - 1));
        const Vector3d normal = place.turn.transpose() * levelSet.frame.linear() * gradient;
        const double angle =
            kDegrees * std::acos(std::min(1.0, normal.normalized().dot(shape.normal(x).normalized())));
        truth.rms += miss * miss;
        truth.normalMean += angle;
        truth.normalRms += angle * angle;
        ++count;
      }
  EXPECT_GT(count, 50);
  truth.rms = std::sqrt(truth.rms / count);
  truth.normalMean /= count;
  truth.normalRms = std::sqrt(truth.normalRms / count);
  return truth;
}

/// test(level set, place) for a shape at some places on a grid of one millimetre.
template <typename Test>
void atRandomPlaces(const Shape& shape, const Test& test) {
  std::mt19937 random(kSeed);
  for (int n = 0; n < kPlaces; ++n) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", place " << n);
    const Place place = randomPlace(random);
    const Segmentation s = voxels(shape, place, sinew::test::centredGeometry({48, 48, 48}, Vector3d::Ones()));
    test(denseLevelSetFromLabels(s, s.tissues.at(0)), place);
  }
}

/// The motion by mean curvature that takes the rest of the stairs away, at no cost to volume and topology.
void smoothLightly(DenseLevelSet& levelSet) {
  smooth(levelSet, {.time = 0.3 * levelSet.voxelSize * levelSet.voxelSize, .preserve = Preserve::Both});
}

TEST(LabelsToDistance, ABallIsRoundAtEveryPlace) {
  atRandomPlaces(kBall, [](DenseLevelSet levelSet, const Place& place) {
    const Truth truth = truthOf(levelSet, kBall, place);
    EXPECT_LT(truth.rms, 0.09) << "0.074 to 0.085 measured: what is left of the stairs after the Gauss";
    EXPECT_LT(truth.normalRms, 4);
    EXPECT_NEAR(shapeVolume(levelSet) / kBall.volume, 1, 0.005);
    smoothLightly(levelSet);
    const Truth smoothed = truthOf(levelSet, kBall, place);
    EXPECT_LT(smoothed.rms, 0.07);
    EXPECT_LT(smoothed.normalRms, 3);
    EXPECT_NEAR(shapeVolume(levelSet) / kBall.volume, 1, 0.005);
  });
}

TEST(LabelsToDistance, PlatesAndTubesAreWholeAtEveryPlace) {
  for (const Shape& shape : {kPlate, kTube}) {
    atRandomPlaces(shape, [&](DenseLevelSet levelSet, const Place&) {
      EXPECT_EQ(shapeTopology(levelSet).components, 1);
      EXPECT_NEAR(shapeVolume(levelSet) / shape.volume, 1, 0.05);
      smoothLightly(levelSet);
      EXPECT_EQ(shapeTopology(levelSet).components, 1);
      EXPECT_NEAR(shapeVolume(levelSet) / shape.volume, 1, 0.05);
    });
  }
}

TEST(LabelsToDistance, ATiltedPlateInSlicesFourTimesAsThickHasTrueNormals) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const bool acrossSlices : {false, true}) {
    for (int n = 0; n < 3; ++n) {
      SCOPED_TRACE(testing::Message()
                   << "seed " << kSeed << ", place " << n << ", across slices " << acrossSlices);
      const double tilt = (20 + (acrossSlices ? 90 : 0)) / kDegrees;
      const Place place{(Eigen::AngleAxisd(std::numbers::pi * u(random), Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(tilt, Vector3d::UnitY()))
                            .toRotationMatrix(),
                        0.5 * Vector3d(u(random), u(random), u(random))};
      const Segmentation s = voxels(kPlate, place, test::centredGeometry({134, 134, 36}, {0.25, 0.25, 1}));
      EXPECT_LT(truthOf(denseLevelSetFromLabels(s, s.tissues.at(0)), kPlate, place).normalMean, 3);
    }
  }
}

}  // namespace
}  // namespace sinew
