#include "Sampling.h"
#include "Shapes.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/LevelSet/VoxelsInside.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

TEST(VoxelsInside, AreThoseWhoseCentresAreInside) {
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const ImageGeometry geometry = test::centredGeometry({30, 28, 12}, {0.8, 0.9, 2}, tilt);
  const auto ball = test::ball({1, -1, 0.5}, 8);
  const PhiAtVoxels voxels = phiAtVoxels(test::levelSetOf(ball, 16, 0.7), geometry);
  ASSERT_TRUE((voxels.box.upper.array() <= geometry.size.array()).all());
  int inside = 0;
  for (int k = 0; k < geometry.size.z(); ++k)
    for (int j = 0; j < geometry.size.y(); ++j)
      for (int i = 0; i < geometry.size.x(); ++i) {
        const double exact = ball(geometry.indexToPhysical() * Vector3d(i, j, k));
        const Vector3i at = Vector3i(i, j, k) - voxels.box.lower;
        const bool held = (at.array() >= 0).all() && (at.array() < voxels.phi.size.array()).all();
        const float phi = held ? voxels.phi(at.x(), at.y(), at.z()) : 1.0F;
        if (std::abs(exact) > 0.02) {
          EXPECT_EQ(phi < 0, exact < 0) << "a tricubic is right to a 50th of a sample";
        }
        inside += exact < 0;
      }
  EXPECT_GT(inside, 1000);
}

TEST(VoxelsInside, ABoxOfVoxelsComesBackAsItWas) {
  ImageGeometry geometry = test::centredGeometry({20, 18, 16}, {1, 1, 1});
  const Segmentation block = test::segmentationOf(geometry, test::block({0.2, 0, -0.1}, {6, 5, 4}));
  const DenseLevelSet levelSet =
      denseLevelSetFromLabels(block, block.tissues[0], {.smoothingVoxels = 0, .onCommonLattice = true});
  const PhiAtVoxels voxels = phiAtVoxels(levelSet, geometry);
  for (int k = voxels.box.lower.z(); k < voxels.box.upper.z(); ++k)
    for (int j = voxels.box.lower.y(); j < voxels.box.upper.y(); ++j)
      for (int i = voxels.box.lower.x(); i < voxels.box.upper.x(); ++i) {
        const Vector3i at = Vector3i(i, j, k) - voxels.box.lower;
        EXPECT_EQ(voxels.phi(at.x(), at.y(), at.z()) < 0, block.at(0, {i, j, k}) == 1);
      }
}

TEST(VoxelsInside, NothingLiesOutsideOfTheImage) {
  ImageGeometry geometry = test::centredGeometry({10, 10, 10}, {1, 1, 1});
  geometry.origin += Vector3d(1e12, 0, 0);
  EXPECT_TRUE(phiAtVoxels(test::levelSetOf(test::ball({0, 0, 0}, 4), 8), geometry).box.empty());
}

}  // namespace
}  // namespace sinew
