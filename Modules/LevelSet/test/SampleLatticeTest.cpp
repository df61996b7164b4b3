#include "Sampling.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Two balls, labels 1 and 2, in an image with these axes.
Segmentation twoBalls(const Vector3d& spacing, const Eigen::Matrix3d& direction) {
  const ImageGeometry geometry = test::centredGeometry({40, 36, 32}, spacing, direction);
  Segmentation balls =
      test::segmentationOf(geometry, [](const Vector3d& x) { return (x - Vector3d(-6, 1, 2)).norm() - 4; });
  const Segmentation other =
      test::segmentationOf(geometry, [](const Vector3d& x) { return (x - Vector3d(5, -3, 1)).norm() - 5; });
  for (std::size_t n = 0; n < balls.layers[0].size(); ++n)
    if (other.layers[0][n] != 0) balls.layers[0][n] = 2;
  updateTissueTable(balls);
  return balls;
}

struct Axes {
  const char* name;
  Vector3d spacing;
  Eigen::Matrix3d direction;
};

std::vector<Axes> axes() {
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Eigen::Matrix3d mirrored = tilt, sheared = Eigen::Matrix3d::Identity();
  mirrored.col(0) *= -1;
  sheared.col(2) = Vector3d(0, -0.2, 1).normalized();
  return {{"isotropic", Vector3d::Ones(), Eigen::Matrix3d::Identity()},
          {"tilted", {0.9, 1, 1.2}, tilt},
          {"mirrored", {0.9, 1, 1.2}, mirrored},
          {"sheared gantry", {1, 1, 1.1}, sheared},
          {"thick slices", {0.7, 0.7, 2.1}, tilt},
          {"thick and mirrored", {2.1, 0.7, 0.7}, mirrored}};
}

TEST(SampleLattice, HoldsEveryTissueOfAScan) {
  for (const Axes& scan : axes()) {
    const Segmentation balls = twoBalls(scan.spacing, scan.direction);
    for (const double spacing : {0.0, 0.63, 2.3}) {
      SCOPED_TRACE(std::string(scan.name) + ", spacing " + std::to_string(spacing));
      const SampleLattice lattice = commonLattice(balls.geometry, spacing);
      EXPECT_NEAR(lattice.frame.linear().determinant(), 1, 1e-12);
      for (const Tissue& tissue : balls.tissues) {
        LevelSetFromLabelsReport report;
        const DenseLevelSet ball = denseLevelSetFromLabels(
            balls, tissue, {.gridSpacing = spacing, .onCommonLattice = true}, &report);
        EXPECT_TRUE(firstSampleOn(lattice, ball)) << tissue.name;
        // The offset that keeps the volume ends at 1e-5 of it, or half a voxel away.
        if (spacing < 1) {
          EXPECT_NEAR(report.levelSetVolume / report.labelVolume, 1, 1e-3) << tissue.name;
        }
      }
    }
  }
}

TEST(SampleLattice, OtherSamplesAreNotOnIt) {
  const SampleLattice lattice{.spacing = 0.5};
  DenseLevelSet levelSet = emptyLevelSet(lattice, {-3, 2, 10}, {5, 6, 20}, 2);
  EXPECT_EQ(firstSampleOn(lattice, levelSet), Vector3i(-3, 2, 10));
  levelSet.frame.translation().x() += 0.1;
  EXPECT_FALSE(firstSampleOn(lattice, levelSet)) << "shifted";
  levelSet.frame.translation().x() += 0.4;
  EXPECT_EQ(firstSampleOn(lattice, levelSet), Vector3i(-2, 2, 10));
  levelSet.frame.translation().x() += 1e12;
  EXPECT_FALSE(firstSampleOn(lattice, levelSet)) << "farther away than whole numbers count";
  levelSet.frame.translation().x() -= 1e12;
  levelSet.voxelSize = 0.51;
  EXPECT_FALSE(firstSampleOn(lattice, levelSet)) << "another spacing";
}

TEST(SampleLattice, ABoxKeepsWhatItHolds) {
  DenseLevelSet levelSet = emptyLevelSet({}, {0, 0, 0}, {9, 9, 9}, 3);
  levelSet.phi(4, 5, 6) = -1;
  levelSet.phi(5, 5, 6) = 2;
  const DenseLevelSet small = trimmed(levelSet);
  EXPECT_EQ(small.phi.size, Vector3i(4, 3, 3)) << "two samples and one layer around";
  EXPECT_EQ(small.phi(1, 1, 1), -1);
  EXPECT_EQ(small.frame.translation(), Vector3d(3, 4, 5));
  const DenseLevelSet large = onBox(small, {-3, -4, -5}, {6, 5, 4});
  EXPECT_EQ(large.phi.values, levelSet.phi.values);
  EXPECT_EQ(large.frame.translation(), levelSet.frame.translation());
}

TEST(SampleLattice, AnEmptyShapeIsTrimmedToNothingButBand) {
  const DenseLevelSet nothing = trimmed(emptyLevelSet({}, {0, 0, 0}, {9, 9, 9}, 3));
  for (const float value : nothing.phi.values) EXPECT_EQ(value, 3);
  EXPECT_LE(nothing.phi.values.size(), 27U);
}

}  // namespace
}  // namespace sinew
