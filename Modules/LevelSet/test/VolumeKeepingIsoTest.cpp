#include "sinew/LevelSet/VolumeKeepingIso.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace sinew {
namespace {

TEST(VolumeKeepingIso, AsManySamplesLieAboveItAsAskedFor) {
  DenseField field({10, 10, 10});
  for (std::size_t n = 0; n < 1000; ++n) field.values[n] = static_cast<float>(n * 37 % 1000) / 1000.0F;
  for (const std::int64_t count : {1, 10, 333, 500, 990}) {
    const double iso = volumeKeepingIso(field, count);
    const auto above =
        std::count_if(field.values.begin(), field.values.end(), [&](float v) { return v > iso; });
    EXPECT_NEAR(static_cast<double>(above), static_cast<double>(count), 1)
        << "values are 1/1000 apart, bins 1/4096";
  }
}

TEST(VolumeKeepingIso, SeparatesAMaskThatIsNotSmoothed) {
  DenseField field({4, 4, 4});
  std::fill_n(field.values.begin(), 20, 1.0F);
  const double iso = volumeKeepingIso(field, 20);
  EXPECT_GT(iso, 0);
  EXPECT_LT(iso, 1);
}

TEST(VolumeKeepingIso, RefusesACountThatLeavesNoSurface) {
  const DenseField field({2, 2, 2});
  EXPECT_THROW(volumeKeepingIso(field, 0), std::invalid_argument);
  EXPECT_THROW(volumeKeepingIso(field, 8), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
