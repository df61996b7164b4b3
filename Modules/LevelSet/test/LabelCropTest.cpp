#include "Sampling.h"
#include "sinew/LevelSet/LabelCrop.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

/// An odd-shaped tissue in an image with the given axes.
Segmentation scan(const Matrix3d& direction) {
  ImageGeometry geometry{{9, 8, 7}, {0.5, 0.7, 1.3}, {10, -20, 30}, direction};
  const Eigen::Affine3d toIndex = geometry.indexToPhysical().inverse();
  return test::segmentationOf(geometry, [&](const Vector3d& x) {
    const Vector3d i = toIndex * x;
    return i.x() < 2.5 && i.y() < 3.5 && i.z() < 4.5 && i.sum() < 7.5 ? -1.0 : 1.0;
  });
}

Matrix3d mirrored() { return Vector3d(-1, 1, 1).asDiagonal(); }
Matrix3d oblique() { return Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix(); }
Matrix3d sheared() {
  Matrix3d direction = oblique();
  direction.col(2) = (direction.col(2) + 0.3 * direction.col(1)).normalized();
  return direction;
}

TEST(LabelCrop, EveryVoxelKeepsItsPlaceAndItsLabelForAnyAxes) {
  for (const Matrix3d& direction : {Matrix3d(Matrix3d::Identity()), mirrored(), oblique(), sheared()})
    for (int lastAxis = 0; lastAxis < 3; ++lastAxis) {
      const Segmentation s = scan(direction);
      const LabelCrop crop = cropLabel(s, s.tissues[0], {2, 3, 1}, lastAxis);
      EXPECT_GT(crop.indexToPhysical.linear().determinant(), 0);
      EXPECT_NEAR(crop.spacing.z(), s.geometry.spacing[lastAxis], 0);
      const Eigen::Affine3d toIndex = s.geometry.indexToPhysical().inverse() * crop.indexToPhysical;
      std::int64_t count = 0;
      for (int k = 0; k < crop.coverage.size.z(); ++k)
        for (int j = 0; j < crop.coverage.size.y(); ++j)
          for (int i = 0; i < crop.coverage.size.x(); ++i) {
            const Vector3d at = toIndex * Vector3d(i, j, k);
            const Vector3i voxel = at.array().round().cast<int>();
            ASSERT_LT((at - voxel.cast<double>()).norm(), 1e-9);
            const bool inImage =
                (voxel.array() >= 0).all() && (voxel.array() < s.geometry.size.array()).all();
            ASSERT_EQ(crop.coverage(i, j, k) != 0, inImage && s.at(0, voxel) == 1);
            count += crop.coverage(i, j, k) != 0;
          }
      EXPECT_EQ(count, s.tissues[0].voxels);
    }
}

TEST(LabelCrop, HasTheMarginOnEverySide) {
  const Segmentation s = scan(Matrix3d::Identity());
  const LabelCrop crop = cropLabel(s, s.tissues[0], {2, 3, 1});
  const VoxelBox& box = s.tissues[0].box;
  EXPECT_EQ(crop.coverage.size, Vector3i(box.upper - box.lower + 2 * Vector3i(2, 3, 1)));
}

TEST(LabelCrop, BlocksOfVoxelsKeepTheVolumeAndItsCentre) {
  for (const Matrix3d& direction : {Matrix3d(Matrix3d::Identity()), mirrored(), sheared()})
    for (int lastAxis = 0; lastAxis < 3; ++lastAxis) {
      const Segmentation s = scan(direction);
      const Vector3i block(2, 1, 3);
      const LabelCrop fine = cropLabel(s, s.tissues[0], {2, 3, 1}, lastAxis);
      const LabelCrop coarse = cropLabel(s, s.tissues[0], {1, 1, 1}, lastAxis, block);
      EXPECT_NEAR(coarse.spacing.z(), s.geometry.spacing[lastAxis] * block[lastAxis], 1e-12);
      const auto moments = [](const LabelCrop& crop) {  // volume in voxels, and its first moment
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (int k = 0; k < crop.coverage.size.z(); ++k)
          for (int j = 0; j < crop.coverage.size.y(); ++j)
            for (int i = 0; i < crop.coverage.size.x(); ++i) {
              const double voxels = crop.coverage(i, j, k) * crop.block.prod();
              sum[0] += voxels;
              sum.tail<3>() += voxels * (crop.indexToPhysical * Vector3d(i, j, k));
            }
        return sum;
      };
      EXPECT_NEAR(moments(fine)[0], static_cast<double>(s.tissues[0].voxels), 1e-9);
      EXPECT_NEAR(moments(coarse)[0], moments(fine)[0], 1e-4);
      const Vector3d shift = (moments(coarse) - moments(fine)).tail<3>() / moments(fine)[0];
      // A voxel moves to the middle of its block: less than half a block off, none on average where all are
      // full.
      EXPECT_LT(shift.norm(), 0.5 * coarse.spacing.norm());
    }
}

TEST(LabelCrop, AFullBlockLiesInTheMiddleOfItsVoxels) {
  ImageGeometry geometry{{8, 8, 8}, {0.5, 0.7, 1.3}, {10, -20, 30}, oblique()};
  const Eigen::Affine3d toIndex = geometry.indexToPhysical().inverse();
  const Segmentation s = test::segmentationOf(geometry, [&](const Vector3d& x) {
    const Vector3d i = toIndex * x;
    return (i.array() > 1.5).all() && (i.array() < 5.5).all() ? -1.0 : 1.0;
  });
  const LabelCrop crop = cropLabel(s, s.tissues[0], {1, 1, 1}, 2, {2, 4, 2});
  EXPECT_EQ(crop.coverage.size, Vector3i(4, 3, 4));
  EXPECT_EQ(crop.coverage(1, 1, 1), 1);
  EXPECT_EQ(crop.coverage(0, 1, 1), 0);
  const Vector3d at = toIndex * (crop.indexToPhysical * Vector3d(1, 1, 1));
  EXPECT_LT((at - Vector3d(2.5, 3.5, 2.5)).norm(), 1e-9);
}

TEST(LabelCrop, CellsThatAreMostlyTissueCount) {
  DenseField coverage({3, 1, 1});
  coverage.values = {0.49F, 0.5F, 1};
  EXPECT_EQ(mostlyCovered(coverage).values, (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST(LabelCrop, RefusesATissueThatIsNotThere) {
  const Segmentation s = scan(Matrix3d::Identity());
  Tissue tissue = s.tissues[0];
  tissue.layer = 1;
  EXPECT_THROW(cropLabel(s, tissue, Vector3i::Ones()), std::invalid_argument);
  tissue = s.tissues[0];
  tissue.voxels = 0;
  EXPECT_THROW(cropLabel(s, tissue, Vector3i::Ones()), std::invalid_argument);
  tissue = s.tissues[0];
  tissue.box.upper.x() = 100;
  EXPECT_THROW(cropLabel(s, tissue, Vector3i::Ones()), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
