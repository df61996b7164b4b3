#include "Sampling.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/LevelSet/LevelSetGrid.h"
#include "sinew/LevelSet/LevelSetMeasures.h"

#include <gtest/gtest.h>
#include <openvdb/tools/Interpolation.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using test::centredGeometry;
using test::segmentationOf;

double phiAt(const LevelSet& levelSet, const Vector3d& x) {
  const openvdb::Vec3d i = levelSet.grid->grid->worldToIndex(openvdb::Vec3d(x.x(), x.y(), x.z()));
  return openvdb::tools::QuadraticSampler::sample(levelSet.grid->grid->tree(), i);
}

struct SurfaceError {
  double rms = 0, max = 0,
         mean = 0;  ///< mm; of the level set's surface against the exact one, along the normal
  std::int64_t samples = 0;
};

/// Where the level set is within half a voxel of zero, its value against the exact distance.
template <typename Function>
SurfaceError surfaceError(const LevelSet& levelSet, const Function& exact) {
  SurfaceError error;
  for (auto it = levelSet.grid->grid->cbeginValueOn(); it; ++it) {
    if (std::abs(*it) > 0.5 * levelSet.voxelSize) continue;
    const openvdb::Vec3d x = levelSet.grid->grid->indexToWorld(it.getCoord());
    const double miss = exact(Vector3d(x.x(), x.y(), x.z())) - *it;
    error.rms += miss * miss;
    error.mean += miss;
    error.max = std::max(error.max, std::abs(miss));
    ++error.samples;
  }
  error.rms = std::sqrt(error.rms / static_cast<double>(error.samples));
  error.mean /= static_cast<double>(error.samples);
  return error;
}

struct Converted {
  LevelSet levelSet;
  LevelSetFromLabelsReport report;
  double volumeError() const { return report.levelSetVolume / report.labelVolume - 1; }
};

Converted convert(const Segmentation& s, const LevelSetFromLabelsOptions& options = {}) {
  Converted result;
  result.levelSet = levelSetFromLabels(s, s.tissues.at(0), options, &result.report);
  return result;
}

const Vector3d kOffCentre(0.21, -0.34, 0.17);
double ballOffCentre(const Vector3d& x) { return (x - kOffCentre).norm() - 20; }

Matrix3d obliqueAxes() { return Eigen::AngleAxisd(0.35, Vector3d(1, 2, 3).normalized()).toRotationMatrix(); }
Matrix3d mirroredAxes() { return obliqueAxes() * Vector3d(1, -1, 1).asDiagonal(); }
Matrix3d permutedAxes() {
  Matrix3d direction;
  direction << 0, 0, -1, 1, 0, 0, 0, 1, 0;
  return direction;
}
Matrix3d shearedAxes() {
  Matrix3d direction = Matrix3d::Identity();
  direction.col(2) = Vector3d(0, std::sin(0.2), std::cos(0.2));
  return direction;
}

TEST(LevelSetFromLabels, ASphereComesOutWithinATenthOfAVoxel) {
  const Converted c = convert(segmentationOf(centredGeometry({48, 48, 48}, Vector3d::Ones()), ballOffCentre));
  const SurfaceError error = surfaceError(c.levelSet, ballOffCentre);
  EXPECT_LT(error.rms, 0.08) << "0.069 measured for Gauss-iso, 0.2 for the voxels' stairs";
  EXPECT_LT(std::abs(error.mean), 0.02) << "no shift";
  EXPECT_LT(std::abs(c.volumeError()), 0.005);
  EXPECT_FALSE(c.report.shapeInterpolated);
  const LevelSetTopology topology = levelSetTopology(c.levelSet);
  EXPECT_EQ(topology.components, 1);
  EXPECT_EQ(topology.eulerCharacteristic, 2);
}

TEST(LevelSetFromLabels, ACoarseGridKeepsPlaceAndVolume) {
  for (const Matrix3d& direction : {Matrix3d(Matrix3d::Identity()), mirroredAxes()})
    for (const Vector3d& spacing : {Vector3d(0.5, 0.5, 0.5), Vector3d(0.4, 0.4, 1.5)}) {
      SCOPED_TRACE(testing::Message() << "spacing " << spacing.transpose() << " direction\n" << direction);
      const Vector3i size = (Vector3d::Constant(46).cwiseQuotient(spacing)).array().ceil().cast<int>();
      LevelSetFromLabelsOptions options;
      options.gridSpacing = 1.7;
      const Converted c =
          convert(segmentationOf(centredGeometry(size, spacing, direction), ballOffCentre), options);
      EXPECT_EQ(c.levelSet.voxelSize, 1.7);
      EXPECT_FALSE(c.report.shapeInterpolated) << "blocks of 4 x 4 x 1 voxels are nearly cubes";
      const SurfaceError error = surfaceError(c.levelSet, ballOffCentre);
      EXPECT_LT(error.rms, 0.05 * options.gridSpacing);
      EXPECT_LT(std::abs(error.mean), 0.01 * options.gridSpacing);
      EXPECT_LT(std::abs(c.volumeError()), 0.002);
    }
}

TEST(LevelSetFromLabels, LandsInPlaceForAnyAxesAndSpacing) {
  const Vector3d spacings[] = {{1, 1, 1}, {0.9, 1.1, 1.3}, {0.8, 0.8, 2}, {2, 0.8, 0.8}, {0.8, 2, 0.8}};
  for (const Matrix3d& direction :
       {Matrix3d(Matrix3d::Identity()), obliqueAxes(), mirroredAxes(), permutedAxes(), shearedAxes()})
    for (const Vector3d& spacing : spacings) {
      const Vector3i size = (Vector3d::Constant(54).cwiseQuotient(spacing)).array().ceil().cast<int>();
      const Converted c = convert(segmentationOf(centredGeometry(size, spacing, direction), ballOffCentre));
      SCOPED_TRACE(testing::Message() << "spacing " << spacing.transpose() << " direction\n" << direction);
      const Matrix3d r = c.levelSet.frame.linear();
      EXPECT_LT((r * r.transpose() - Matrix3d::Identity()).norm(), 1e-9);
      EXPECT_NEAR(r.determinant(), 1, 1e-9) << "the frame is a rotation";
      const SurfaceError error = surfaceError(c.levelSet, ballOffCentre);
      const double largest = spacing.maxCoeff();
      // Across thick slices the caps may be off by a third of a slice (LEVELSET.md), plus the grid that
      // samples them.
      EXPECT_LT(error.rms, 0.1 * largest);
      EXPECT_LT(error.max, 0.55 * largest);
      EXPECT_LT(std::abs(error.mean), 0.03 * largest);
      EXPECT_LT(std::abs(c.volumeError()), 0.005);
      EXPECT_EQ(c.report.shapeInterpolated, largest >= 1.8 * spacing.minCoeff());
    }
}

TEST(LevelSetFromLabels, ATiltedPlateInThickSlicesHasNoStairs) {
  // 3 mm thick, tilted by 20 degrees against the slices' normal and turned in the slice, 0.33 x 0.33 x 1 mm.
  const Matrix3d turn =
      (Eigen::AngleAxisd(0.47, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.349, Vector3d::UnitY()))
          .toRotationMatrix();
  const auto plate = [&](const Vector3d& x) {
    const Vector3d t = turn.transpose() * x;
    return std::max({std::abs(t.x()) - 1.5, std::abs(t.y()) - 12, std::abs(t.z()) - 12});
  };
  const Converted c = convert(segmentationOf(centredGeometry({90, 90, 30}, {0.33, 0.33, 1}), plate));
  EXPECT_TRUE(c.report.shapeInterpolated);
  double sum = 0;
  int count = 0;
  for (double t = -8; t <= 8; t += 0.07) {
    for (const double y : {-6.0, -3.0, 0.1, 4.2}) {
      for (const double side : {-1.5, 1.5}) {
        const double miss = phiAt(c.levelSet, turn * Vector3d(side, y, t));
        sum += miss * miss;
        ++count;
      }
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 0.04) << "mm, an eighth of a pixel; nearest-neighbour slices give 0.1";
}

TEST(LevelSetFromLabels, ThinPlatesAndTubesSurvive) {
  const Matrix3d tilt = obliqueAxes();
  for (const double thickness : {1.2, 2.0, 3.0}) {
    const auto plate = [&](const Vector3d& x) {
      const Vector3d t = tilt.transpose() * x;
      return std::max({std::abs(t.z()) - thickness / 2, std::abs(t.x()) - 14, std::abs(t.y()) - 14});
    };
    const Converted p = convert(segmentationOf(centredGeometry({44, 44, 44}, Vector3d::Ones()), plate));
    EXPECT_EQ(levelSetTopology(p.levelSet).components, 1) << "plate of " << thickness;
    const auto tube = [&](const Vector3d& x) {
      const Vector3d t = tilt.transpose() * x;
      return std::max(std::hypot(t.x(), t.y()) - thickness / 2, std::abs(t.z()) - 15);
    };
    const Segmentation s = segmentationOf(centredGeometry({44, 44, 44}, Vector3d::Ones()), tube);
    const Converted c = convert(s);
    EXPECT_LT(std::abs(c.volumeError()), 0.02) << "tube of " << thickness;
    if (thickness > 1.5) {
      EXPECT_EQ(levelSetTopology(c.levelSet).components, 1) << "tube of " << thickness;
    }
  }
}

TEST(LevelSetFromLabels, AFewVoxelsAreNeverLost) {
  for (const Vector3d& spacing : {Vector3d(1, 1, 1), Vector3d(0.9, 1.1, 1.4), Vector3d(0.3, 0.3, 1)})
    for (const Matrix3d& direction : {Matrix3d(Matrix3d::Identity()), shearedAxes()})
      for (const int voxels : {1, 2, 4}) {
        Segmentation s = segmentationOf(centredGeometry({9, 9, 9}, spacing, direction),
                                        [](const Vector3d&) { return 1.0; });
        for (int n = 0; n < voxels; ++n)
          s.layers[0][static_cast<std::size_t>(4 * 81 + (4 + n / 2) * 9 + 4 + n % 2)] = 7;
        updateTissueTable(s);
        const Converted c = convert(s);
        EXPECT_GT(c.report.levelSetVolume, 0.3 * c.report.labelVolume)
            << voxels << " voxels, " << spacing.transpose();
        EXPECT_LT(c.report.levelSetVolume, 3 * c.report.labelVolume);
        EXPECT_GE(levelSetTopology(c.levelSet).components, 1);
      }
}

TEST(LevelSetFromLabels, ATissueCutByTheImageBorderIsClosed) {
  for (const Vector3d& spacing : {Vector3d(1, 1, 1), Vector3d(0.7, 0.7, 2)}) {
    // Every voxel is tissue: the level set is the image's box, half a voxel beyond the outermost centres.
    const Segmentation s =
        segmentationOf(centredGeometry({30, 30, 20}, spacing), [](const Vector3d&) { return -1.0; });
    const Converted c = convert(s);
    EXPECT_LT(std::abs(c.volumeError()), 0.005);
    const LevelSetTopology topology = levelSetTopology(c.levelSet);
    EXPECT_EQ(topology.components, 1);
    EXPECT_EQ(topology.eulerCharacteristic, 2);
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d face = 0.5 * spacing.cwiseProduct(Vector3d(30, 30, 20));
      EXPECT_NEAR(phiAt(c.levelSet, face[axis] * Vector3d::Unit(axis)), 0, 0.2 * spacing[axis]);
    }
  }
}

TEST(LevelSetFromLabels, SmoothingZeroKeepsTheVoxels) {
  const Segmentation s = segmentationOf(centredGeometry({30, 30, 30}, Vector3d::Ones()),
                                        [](const Vector3d& x) { return x.norm() - 9; });
  const Converted c = convert(s, {.smoothingVoxels = 0});
  auto values = c.levelSet.grid->grid->getConstAccessor();
  std::int64_t inside = 0;
  for (int k = c.levelSet.lower.z(); k <= c.levelSet.upper.z(); ++k)
    for (int j = c.levelSet.lower.y(); j <= c.levelSet.upper.y(); ++j)
      for (int i = c.levelSet.lower.x(); i <= c.levelSet.upper.x(); ++i)
        inside += values.getValue({i, j, k}) < 0;
  EXPECT_EQ(inside, s.tissues[0].voxels);
}

TEST(LevelSetFromLabels, TheGridSpacingIsTheCallersToChoose) {
  const Segmentation s = segmentationOf(centredGeometry({48, 48, 48}, Vector3d::Ones()), ballOffCentre);
  for (const double spacing : {0.5, 0.73, 2.0}) {
    const Converted c = convert(s, {.gridSpacing = spacing});
    EXPECT_EQ(c.levelSet.voxelSize, spacing);
    EXPECT_LT(surfaceError(c.levelSet, ballOffCentre).rms, 0.1 * std::max(1.0, spacing));
    EXPECT_LT(std::abs(c.volumeError()), 0.005);
  }
}

TEST(LevelSetFromLabels, TheNumberOfThreadsDoesNotShow) {
  for (const Vector3d& spacing : {Vector3d(1, 1.2, 1.3), Vector3d(0.8, 0.8, 2)}) {
    const Segmentation s =
        segmentationOf(centredGeometry({60, 60, 50}, spacing, obliqueAxes()), ballOffCentre);
    const auto run = [&] { return convert(s).levelSet.grid->grid; };
    const auto one = test::onThreads(1, run), four = test::onThreads(4, run);
    auto a = one->tree().cbeginLeaf(), b = four->tree().cbeginLeaf();
    for (; a && b; ++a, ++b) ASSERT_EQ(*a, *b);
    EXPECT_FALSE(a || b);
  }
}

TEST(LevelSetFromLabels, RefusesOptionsOutOfRange) {
  const Segmentation s = segmentationOf(centredGeometry({9, 9, 9}, Vector3d::Ones()),
                                        [](const Vector3d& x) { return x.norm() - 2; });
  EXPECT_THROW(convert(s, {.smoothingVoxels = -1}), std::invalid_argument);
  EXPECT_THROW(convert(s, {.bandVoxels = 2}), std::invalid_argument);
  EXPECT_THROW(convert(s, {.thickSliceRatio = 0.5}), std::invalid_argument);
  EXPECT_THROW(convert(s, {.gridSpacing = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
