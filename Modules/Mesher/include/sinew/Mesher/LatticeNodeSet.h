#pragma once

#include "sinew/Mesher/BccLattice.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace sinew {

/// Number of ones. Without an option for a newer processor std::popcount is a call into the compiler's
/// library.
constexpr int countOnes(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555U;                                  // in every 2 bits
  bits = (bits & 0x3333333333333333U) + (bits >> 2 & 0x3333333333333333U);  // in every 4
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fU;                        // in every 8
  return static_cast<int>(bits * 0x0101010101010101U >> 56);
}

/// A set of lattice nodes, all levels together, as bits in pages of 8^3 finest cubes (two nodes per cube),
/// and the rank of each node: its index in the order of pages, then of bits. No hash tables, and no
/// dependence on the order in which nodes were put in.
class LatticeNodeSet {
 public:
  /// @param cells  box of finest cubes; coordinates are half cubes, 0 <= p < 2 cells
  explicit LatticeNodeSet(Int3 cells);

  bool contains(Int3 p) const {
    const std::int32_t page = pageOf_[pageIndex(p)];
    return page >= 0 && (pages_[page][wordIndex(p)] >> bitIndex(p) & 1U) != 0;
  }
  /// @return true when p was not yet in the set. @throws std::logic_error outside of the box.
  bool insert(Int3 p);

  /// A large number of nodes, in parallel: first the pages of all of them, then the nodes, from any thread.
  /// Points must lie in the box.
  std::size_t pageIndex(Int3 p) const {
    return (static_cast<std::size_t>(p.z >> 4) * pageCounts_.y + (p.y >> 4)) * pageCounts_.x + (p.x >> 4);
  }
  bool hasPage(std::size_t index) const { return pageOf_[index] >= 0; }
  void addPages(const std::vector<std::size_t>& indices);
  /// @return true when p was not yet in the set, for one of the threads that insert it
  bool insertConcurrently(Int3 p) {
    const std::atomic_ref word(pages_[pageOf_[pageIndex(p)]][wordIndex(p)]);
    const std::uint64_t bit = std::uint64_t{1} << bitIndex(p);
    if ((word.load(std::memory_order_relaxed) & bit) != 0) return false;
    return (word.fetch_or(bit, std::memory_order_relaxed) & bit) == 0;
  }

  /// Numbers the nodes; call once all are in.
  void rank();
  std::int32_t size() const { return size_; }
  /// Index of a node that is in the set.
  std::int32_t indexOf(Int3 p) const {
    const std::int32_t page = pageOf_[pageIndex(p)];
    const int word = wordIndex(p);
    const std::uint64_t below = pages_[page][word] & ((std::uint64_t{1} << bitIndex(p)) - 1);
    return ranks_[page][word] + countOnes(below);
  }
  /// The nodes in the order of their index. Cost: O(box / page + nodes), parallel.
  std::vector<Int3> nodes() const;

 private:
  static constexpr int kWords = 16;
  using Page = std::array<std::uint64_t, kWords>;

  // Half cube p: page p >> 4, cube (p >> 1) & 7 inside, sublattice p & 1; bit (z * 8 + y) * 16 + 2 x +
  // sublattice.
  static int wordIndex(Int3 p) { return ((p.z >> 1 & 7) << 1) | (p.y >> 3 & 1); }
  static int bitIndex(Int3 p) { return ((p.y >> 1 & 3) << 4) | (p.x & 15); }

  Int3 cells_;
  Int3 pageCounts_;
  std::vector<std::int32_t> pageOf_;
  std::vector<Page> pages_;
  std::vector<std::array<std::int32_t, kWords>> ranks_;
  std::int32_t size_ = 0;
};

}  // namespace sinew
