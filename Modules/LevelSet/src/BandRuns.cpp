#include "BandRuns.h"

#include <tbb/parallel_for.h>

namespace sinew {
namespace {

template <typename T, typename Predicate>
std::vector<BandSlice> runsWhere(const DenseRaster<T>& raster, const Predicate& holds) {
  std::vector<BandSlice> slices(static_cast<std::size_t>(raster.size.z()));
  tbb::parallel_for(0, raster.size.z(), [&](int k) {
    BandSlice& slice = slices[static_cast<std::size_t>(k)];
    const int nx = raster.size.x();
    for (int j = 0; j < raster.size.y(); ++j) {
      const T* row = raster.row(j, k);
      for (int i = 0; i < nx; ++i) {
        if (!holds(row[i])) continue;
        const int first = i;
        while (i < nx && holds(row[i])) ++i;
        slice.runs.push_back({j, first, i, slice.samples});
        slice.samples += static_cast<std::size_t>(i - first);
      }
    }
  });
  return slices;
}

}  // namespace

std::vector<BandSlice> bandRuns(const DenseField& phi, float within) {
  return runsWhere(phi, [&](float v) { return std::abs(v) < within; });
}

std::vector<BandSlice> bandRuns(const DenseMask& steps, int atMost) {
  return runsWhere(steps, [&](std::uint8_t s) { return s <= atMost; });
}

}  // namespace sinew
