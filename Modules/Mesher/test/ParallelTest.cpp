#include "Parallel.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <memory>

namespace sinew {
namespace {

TEST(Parallel, CollectKeepsTheOrderForAnyNumberOfThreads) {
  constexpr std::size_t count = 10 * kBlock + 7;
  std::vector<std::size_t> expected;  // i, i mod 3 times
  for (std::size_t i = 0; i < count; ++i) expected.insert(expected.end(), i % 3, i);
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    for (const std::size_t block : {kBlock, std::size_t{5}, 2 * count}) {
      const auto collected = collect<std::size_t>(
          count, [](std::size_t i, auto& out) { out.insert(out.end(), i % 3, i); }, block);
      EXPECT_EQ(collected, expected) << threads << " threads, block " << block;
    }
  }
}

TEST(Parallel, CollectOfNothingIsEmpty) {
  EXPECT_TRUE(collect<int>(0, [](std::size_t, auto& out) { out.push_back(1); }).empty());
  EXPECT_TRUE(collect<int>(3 * kBlock, [](std::size_t, auto&) {}).empty());
}

TEST(Parallel, ConcatenatedMovesWhatCannotBeCopied) {
  std::vector<std::vector<std::unique_ptr<int>>> lists(3);
  lists[0].push_back(std::make_unique<int>(1));
  lists[2].push_back(std::make_unique<int>(2));
  const auto all = concatenated(std::move(lists));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(*all[0], 1);
  EXPECT_EQ(*all[1], 2);
}

TEST(Parallel, ForEachVisitsEveryIndexOnce) {
  std::vector<std::uint8_t> visits(3 * kBlock + 1, 0), flag(1, 0);
  forEach(visits.size(), [&](std::size_t i) {
    ++visits[i];
    setFlag(flag[0]);
  });
  EXPECT_EQ(std::ranges::count(visits, 1), std::ssize(visits));
  EXPECT_TRUE(isSet(flag[0]));
}

}  // namespace
}  // namespace sinew
