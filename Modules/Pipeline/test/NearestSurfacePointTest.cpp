#include "NearestSurfacePoint.h"
#include "sinew/TestSupport/AnalyticDistance.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

TEST(NearestSurfacePoint, LiesOnTheRayFromTheCentreOfABall) {
  const test::AnalyticSphere ball(Eigen::Vector3d(1, 2, 3), 10);
  const Eigen::Vector3d direction = Eigen::Vector3d(1, -2, 2) / 3;
  for (const double offset : {0., 0.3})
    for (const double from : {9., 10., 11.5}) {
      const auto point = nearestSurfacePoint(ball, offset, Eigen::Vector3d(1, 2, 3) + from * direction);
      ASSERT_TRUE(point);
      // Newton's method is exact on a ball.
      EXPECT_LT((*point - Eigen::Vector3d(1, 2, 3) - (10 + offset) * direction).norm(), 1e-9);
    }
}

TEST(NearestSurfacePoint, IsNoneWhereTheDistanceIsClamped) {
  const test::AnalyticSphere ball(Eigen::Vector3d::Zero(), 10, {.band = 2});
  EXPECT_FALSE(nearestSurfacePoint(ball, 0, Eigen::Vector3d(15, 0, 0)));
}

}  // namespace
}  // namespace sinew
