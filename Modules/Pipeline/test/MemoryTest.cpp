#include "sinew/Pipeline/Memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sinew {
namespace {

TEST(Memory, FormatsLikePeopleSay) {
  EXPECT_EQ(formatBytes(0), "0 B");
  EXPECT_EQ(formatBytes(999), "999 B");
  EXPECT_EQ(formatBytes(1400), "1.4 kB");
  EXPECT_EQ(formatBytes(320e6), "320 MB");
  EXPECT_EQ(formatBytes(1.44e9), "1.4 GB");
  EXPECT_EQ(formatBytes(999.9e6), "1.0 GB");
  EXPECT_EQ(formatBytes(5e18), "5000 PB");
}

TEST(Memory, SomeIsAvailable) {
  EXPECT_TRUE(std::isfinite(availableMemory()));  // Linux always tells
  EXPECT_GT(availableMemory(), 1e6);
}

TEST(Memory, ThePeakHoldsWhatWasTouched) {
  const double before = peakMemory();
  std::vector<char> block(static_cast<std::size_t>(before) + 50'000'000, 1);
  EXPECT_GT(peakMemory(), static_cast<double>(block.size()) * block.back());
}

}  // namespace
}  // namespace sinew
