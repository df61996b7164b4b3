#include "sinew/Pipeline/Length.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

TEST(Length, MillimetresAreTheDefaultUnit) {
  EXPECT_EQ(parseLength("1.5").millimetres(7), 1.5);
  EXPECT_EQ(parseLength("1.5mm").millimetres(7), 1.5);
  EXPECT_EQ(parseLength("2vox").millimetres(7), 14);
  EXPECT_EQ(parseLength("-1e-2").millimetres(7), -0.01);
}

TEST(Length, TextReadsBack) {
  for (const Length length : {Length(0.1), Length::voxels(2), Length(1e-7), Length::voxels(1. / 3)}) {
    const Length back = parseLength(toString(length));
    EXPECT_EQ(back.value, length.value);
    EXPECT_EQ(back.inVoxels, length.inVoxels);
  }
}

TEST(Length, OtherTextIsRefused) {
  for (const char* text : {"", "mm", "1.5 mm", "1.5cm", "1,5", "nan", "inf", "1e999", "2voxel", "0x10"})
    EXPECT_THROW(parseLength(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace sinew
