#include "sinew/Mesher/LatticeNodeSet.h"

#include <tbb/parallel_for.h>

#include <bit>
#include <stdexcept>

namespace sinew {

LatticeNodeSet::LatticeNodeSet(Int3 cells)
    : cells_(cells), pageCounts_{(cells.x + 7) / 8, (cells.y + 7) / 8, (cells.z + 7) / 8} {
  const std::size_t pages = static_cast<std::size_t>(pageCounts_.x) * pageCounts_.y * pageCounts_.z;
  pageOf_.assign(pages, -1);
}

bool LatticeNodeSet::insert(Int3 p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < 0 || p[axis] >= 2 * cells_[axis])
      throw std::logic_error("LatticeNodeSet::insert: outside of the box");
  }
  addPages({pageIndex(p)});
  return insertConcurrently(p);
}

void LatticeNodeSet::addPages(const std::vector<std::size_t>& indices) {
  for (const std::size_t index : indices) {
    if (hasPage(index)) continue;
    pageOf_[index] = static_cast<std::int32_t>(pages_.size());
    pages_.emplace_back().fill(0);
  }
}

void LatticeNodeSet::rank() {
  ranks_.resize(pages_.size());
  std::int32_t count = 0;
  for (const std::int32_t page : pageOf_) {
    if (page < 0) continue;
    for (int w = 0; w < kWords; ++w) {
      ranks_[page][w] = count;
      count += countOnes(pages_[page][w]);
    }
  }
  size_ = count;
}

std::vector<Int3> LatticeNodeSet::nodes() const {
  std::vector<Int3> list(size_);
  tbb::parallel_for(0, pageCounts_.z, [&](int z) {
    for (int y = 0; y < pageCounts_.y; ++y) {
      for (int x = 0; x < pageCounts_.x; ++x) {
        const std::int32_t page = pageOf_[pageIndex({16 * x, 16 * y, 16 * z})];
        if (page < 0) continue;
        std::int32_t next = ranks_[page][0];
        for (int w = 0; w < kWords; ++w) {
          for (std::uint64_t bits = pages_[page][w]; bits != 0; bits &= bits - 1) {
            const int b = std::countr_zero(bits);
            const int sublattice = b & 1;
            list[next++] = {16 * x + (b & 15), 16 * y + 8 * (w & 1) + 2 * (b >> 4) + sublattice,
                            16 * z + 2 * (w >> 1) + sublattice};
          }
        }
      }
    }
  });
  return list;
}

}  // namespace sinew
