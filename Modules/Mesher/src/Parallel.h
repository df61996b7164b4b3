#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sinew {

inline constexpr std::size_t kBlock = 4096;  // items that are cheap, per task

/// Sets a flag that other threads may set or read as well.
inline void setFlag(std::uint8_t& flag) { std::atomic_ref(flag).store(1, std::memory_order_relaxed); }
inline bool isSet(std::uint8_t& flag) { return std::atomic_ref(flag).load(std::memory_order_relaxed) != 0; }

/// Calls f(i) for i < count, each on its own.
template <class Function>
void forEach(std::size_t count, const Function& f, std::size_t blockSize = kBlock) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, blockSize), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) f(i);
  });
}

/// One after the other, moved in parallel.
template <class T>
std::vector<T> concatenated(std::vector<std::vector<T>> lists) {
  if (lists.size() == 1) return std::move(lists[0]);
  std::vector<std::size_t> begin(lists.size() + 1, 0);
  for (std::size_t k = 0; k < lists.size(); ++k) begin[k + 1] = begin[k] + lists[k].size();
  std::vector<T> all(begin.back());
  tbb::parallel_for(std::size_t{0}, lists.size(), [&](std::size_t k) {
    std::ranges::move(lists[k], all.begin() + static_cast<std::ptrdiff_t>(begin[k]));
    std::vector<T>().swap(lists[k]);
  });
  return all;
}

/// What f(i, out) puts into out for i < count, in the order of i whatever the threads do.
template <class T, class Function>
std::vector<T> collect(std::size_t count, const Function& f, std::size_t blockSize = kBlock) {
  std::vector<std::vector<T>> found((count + blockSize - 1) / blockSize);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t block) {
    const std::size_t end = std::min(count, (block + 1) * blockSize);
    for (std::size_t i = block * blockSize; i < end; ++i) f(i, found[block]);
  });
  return concatenated(std::move(found));
}

}  // namespace sinew
