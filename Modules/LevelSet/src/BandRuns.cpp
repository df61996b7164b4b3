#include "BandRuns.h"

#include <tbb/parallel_for.h>

namespace sinew {

std::vector<BandSlice> bandRuns(const DenseField& phi, float within) {
  std::vector<BandSlice> slices(static_cast<std::size_t>(phi.size.z()));
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    BandSlice& slice = slices[static_cast<std::size_t>(k)];
    const int nx = phi.size.x();
    for (int j = 0; j < phi.size.y(); ++j) {
      const float* row = phi.row(j, k);
      for (int i = 0; i < nx; ++i) {
        if (!(std::abs(row[i]) < within)) continue;
        const int first = i;
        while (i < nx && std::abs(row[i]) < within) ++i;
        slice.runs.push_back({j, first, i, slice.samples});
        slice.samples += static_cast<std::size_t>(i - first);
      }
    }
  });
  return slices;
}

}  // namespace sinew
