#include "Sampling.h"
#include "sinew/LevelSet/FieldResampling.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

using Eigen::Vector3d;
using test::sampled;

double quadratic(const Vector3d& x) {
  return 1 + x.x() - 2 * x.y() + 0.3 * x.z() * x.z() - 0.1 * x.x() * x.y();
}

TEST(ResampleAxis, ReproducesQuadraticsAwayFromTheEnds) {
  const DenseField field = sampled({9, 9, 9}, Vector3d::Zero(), Vector3d::Ones(), quadratic);
  for (int axis = 0; axis < 3; ++axis) {
    const DenseField result = resampleAxis(field, axis, 2, 0.37, 12);
    ASSERT_EQ(result.size[axis], 12);
    for (int i = 0; i < 12; ++i) {
      Vector3d at(4, 5, 3);
      Eigen::Vector3i index(4, 5, 3);
      at[axis] = 2 + 0.37 * i;
      index[axis] = i;
      EXPECT_NEAR(result(index.x(), index.y(), index.z()), quadratic(at), 1e-5)
          << "Catmull-Rom is exact, float is not";
    }
  }
}

TEST(ResampleAffine, ReproducesQuadraticsUnderAShearedMap) {
  const DenseField field = sampled({12, 12, 12}, Vector3d::Zero(), Vector3d::Ones(), quadratic);
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() << 0.5, 0.2, 0, -0.1, 0.6, 0.1, 0, 0, 0.4;
  map.translation() = Vector3d(3, 4, 3);
  const DenseField result = resampleAffine(field, map, {6, 6, 6});
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(result(n, 5 - n, n), quadratic(map * Vector3d(n, 5 - n, n)), 1e-5);
}

TEST(ResampleAffine, BeyondTheFieldLiesTheNearestSample) {
  const DenseField field({3, 3, 3}, 2.5F);
  const Eigen::Affine3d away(Eigen::Translation3d(50, -50, 0));
  for (const float v : resampleAffine(field, away, {4, 4, 4}).values) EXPECT_EQ(v, 2.5F);
}

}  // namespace
}  // namespace sinew
