#include "Sampling.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetGrid.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::sampled;

constexpr double kNarrowBand = 2, kVoxel = 0.5;

DenseField ball(const Eigen::Vector3i& size = {45, 46, 47}) {
  return sampled(size, Vector3d::Constant(-11), Vector3d::Constant(kVoxel),
                 [](const Vector3d& x) { return std::clamp(x.norm() - 8, -kNarrowBand, kNarrowBand); });
}

Eigen::Isometry3d someFrame() {
  Eigen::Isometry3d frame(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2) / 3));
  frame.pretranslate(Vector3d(5, -6, 7));
  return frame;
}

TEST(LevelSetFromField, EverySampleIsInTheTreeAndTheInsideIsTiled) {
  const DenseField phi = ball();
  const LevelSet levelSet = levelSetFromField({phi, someFrame(), kVoxel, kNarrowBand});
  const openvdb::FloatGrid& grid = *levelSet.grid->grid;
  EXPECT_EQ(grid.getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_FLOAT_EQ(grid.background(), kNarrowBand);
  auto values = grid.getConstAccessor();
  for (int k = 0; k < phi.size.z(); ++k)
    for (int j = 0; j < phi.size.y(); ++j)
      for (int i = 0; i < phi.size.x(); ++i) {
        ASSERT_EQ(values.getValue({i, j, k}), phi(i, j, k));
        ASSERT_EQ(values.isValueOn({i, j, k}), std::abs(phi(i, j, k)) < kNarrowBand);
      }
  EXPECT_EQ(levelSet.upper, Eigen::Vector3i(44, 45, 46));
}

TEST(LevelSetFromField, TheTransformIsTheFrame) {
  const LevelSet levelSet = levelSetFromField({ball(), someFrame(), kVoxel, kNarrowBand});
  const Vector3d index(3, -4, 5.5);
  const Vector3d expected = levelSet.frame * Vector3d(levelSet.voxelSize * index);
  const openvdb::Vec3d x = levelSet.grid->grid->indexToWorld(openvdb::Vec3d(index.x(), index.y(), index.z()));
  EXPECT_LT((expected - Vector3d(x.x(), x.y(), x.z())).norm(), 1e-12);
}

TEST(LevelSetFromField, AnOffsetMovesTheSurfaceOutward) {
  const DenseField phi = ball();
  const LevelSet levelSet = levelSetFromField({phi, someFrame(), kVoxel, 1}, 0.25);
  auto values = levelSet.grid->grid->getConstAccessor();
  EXPECT_FLOAT_EQ(values.getValue({22, 22, 38}), phi(22, 22, 38) - 0.25F);
}

TEST(LevelSetFromField, TheWayBackGivesTheSameField) {
  LevelSet levelSet = levelSetFromField({ball(), someFrame(), kVoxel, kNarrowBand});
  const DenseLevelSet whole = fieldFromLevelSet(levelSet);
  EXPECT_EQ(whole.phi.values, ball().values);
  EXPECT_TRUE(whole.frame.isApprox(someFrame()));
  levelSet.lower = {3, 4, -2};
  const DenseLevelSet part = fieldFromLevelSet(levelSet);
  EXPECT_EQ(part.phi.size, Eigen::Vector3i(42, 42, 49));
  EXPECT_EQ(part.phi(20, 21, 12), ball()(23, 25, 10));
  EXPECT_EQ(part.phi(20, 21, 1), static_cast<float>(kNarrowBand)) << "beyond the field";
  EXPECT_LT((part.frame * Vector3d::Zero() - someFrame() * (kVoxel * Vector3d(3, 4, -2))).norm(), 1e-12);
}

TEST(LevelSetFromField, TheNumberOfThreadsDoesNotShow) {
  const DenseField phi = ball();
  const auto run = [&] { return levelSetFromField({phi, someFrame(), kVoxel, kNarrowBand}).grid->grid; };
  const auto one = test::onThreads(1, run), four = test::onThreads(4, run);
  EXPECT_TRUE(one->tree().hasSameTopology(four->tree()));
  auto a = one->tree().cbeginLeaf(), b = four->tree().cbeginLeaf();
  for (; a && b; ++a, ++b) ASSERT_EQ(*a, *b);
}

TEST(LevelSetFromField, RefusesSizesThatAreNotPositive) {
  const DenseField phi = ball({5, 5, 5});
  EXPECT_THROW(levelSetFromField({phi, someFrame(), 0, 1}), std::invalid_argument);
  EXPECT_THROW(levelSetFromField({phi, someFrame(), 1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
