#include "sinew/Pipeline/Smoothing.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

TEST(Smoothing, IsReadAndWritten) {
  for (const char* text : {"none", "light", "2mm2", "0.25mm2", "1.5mm", "2vox"})
    EXPECT_EQ(toString(parseSmoothing(text)), text);
  EXPECT_EQ(toString(parseSmoothing("2")), "2mm2") << "a number alone is a time";
  EXPECT_EQ(toString(parseSmoothing("2mm^2")), "2mm2");
  EXPECT_EQ(toString(Smoothing{}), "light");
}

TEST(Smoothing, ALengthIsTheSpreadOfAGauss) {
  EXPECT_EQ(parseSmoothing("none").motion(0.5), 0);
  EXPECT_EQ(parseSmoothing("light").motion(0.5), 0);
  EXPECT_EQ(parseSmoothing("3mm2").motion(0.5), 3);
  EXPECT_EQ(parseSmoothing("2mm").motion(0.5), 2);
  EXPECT_EQ(parseSmoothing("2vox").motion(0.5), 0.5);
}

TEST(Smoothing, WhatIsNoneIsRefused) {
  for (const char* text : {"", "much", "-1", "-2vox", "nan", "inf", "2 mm", "2cm", "mm"})
    EXPECT_THROW(parseSmoothing(text), std::invalid_argument) << text;
  EXPECT_EQ(test::messageOf<std::invalid_argument>([] { parseSmoothing("2cm"); }),
            "'2cm' is no smoothing: write none, light, a time like 2mm2 or a length like 1mm or 2vox");
}

}  // namespace
}  // namespace sinew
