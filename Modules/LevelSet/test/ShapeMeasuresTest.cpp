#include "Shapes.h"
#include "sinew/LevelSet/ShapeMeasures.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::ball;
using test::block;
using test::levelSetOf;

TEST(ShapeMeasures, OfABall) {
  const Vector3d center(1.3, -2.1, 0.4);
  DenseLevelSet shape = levelSetOf(ball(center, 9));
  const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()));
  shape.frame = turn * shape.frame;
  EXPECT_NEAR(shapeVolume(shape) / (4 * std::numbers::pi / 3 * 729), 1, 1e-3) << "fieldVolume's own accuracy";
  EXPECT_LT((shapeCentroid(shape) - turn * center).norm(), 0.01) << "symmetric errors cancel";
  const Eigen::AlignedBox3d box = shapeBounds(shape);
  EXPECT_LT((box.center() - turn * center).norm(), 0.15) << "crossings lie within 0.1 of a tangent plane's";
  EXPECT_LT((box.sizes() - Vector3d::Constant(18)).cwiseAbs().maxCoeff(), 0.2);
}

TEST(ShapeMeasures, AnEmptyShapeHasNone) {
  const DenseLevelSet nothing = emptyLevelSet({}, {0, 0, 0}, {5, 5, 5}, 3);
  EXPECT_EQ(shapeVolume(nothing), 0);
  EXPECT_TRUE(shapeBounds(nothing).isEmpty());
  EXPECT_TRUE(std::isnan(shapeCentroid(nothing).x()));
  EXPECT_EQ(shapeTopology(nothing), (ShapeTopology{0, 0}));
}

TEST(ShapeMeasures, SurfacesThatTouchHaveNoVolumeBetweenThem) {
  DenseLevelSet shape = levelSetOf(ball({0.2, 0, 0}, 9));
  for (float& value : shape.phi.values) value = std::abs(value);  // the ball without itself: max(a, -a)
  EXPECT_LT(shapeVolume(shape), 0.005 * 4 * std::numbers::pi / 3 * 729) << "oblique cells half a sample away";
}

TEST(ShapeMeasures, PiecesAndCavities) {
  const auto shell = [](const Vector3d& x) { return std::abs((x - Vector3d(5, 0, 0)).norm() - 6) - 1.5; };
  const auto two = [&](const Vector3d& x) { return std::min(shell(x), ball({-10, 0, 0}, 4)(x)); };
  EXPECT_EQ(shapeTopology(levelSetOf(two)), (ShapeTopology{2, 1}));
  const auto opened = [&](const Vector3d& x) { return std::max(two(x), -block({5, 0, 6}, {2, 2, 3})(x)); };
  EXPECT_EQ(shapeTopology(levelSetOf(opened)), (ShapeTopology{2, 0})) << "a hole leads into the hollow";
}

TEST(ShapeMeasures, PiecesTouchByCornersAndCavitiesByFaces) {
  DenseLevelSet shape = emptyLevelSet({}, {0, 0, 0}, {4, 4, 4}, 1);
  shape.phi(1, 1, 1) = shape.phi(2, 2, 2) = -1;
  EXPECT_EQ(shapeTopology(shape), (ShapeTopology{1, 0}));
  for (float& value : shape.phi.values) value = -value;
  EXPECT_EQ(shapeTopology(shape), (ShapeTopology{1, 2}));
}

}  // namespace
}  // namespace sinew
