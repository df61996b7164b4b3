#include "BenchFields.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// A ball in cubic voxels, or in slices four pixels thick; items are voxels of the level set's raster.
void convertBall(benchmark::State& state, bool thick) {
  const int n = static_cast<int>(state.range(0));
  const DenseMask mask = bench::ballMask(n);
  Segmentation segmentation;
  segmentation.geometry.size = {n, n, thick ? n / 4 : n};
  segmentation.geometry.spacing.z() = thick ? 4 : 1;
  segmentation.layers.resize(1);
  for (int k = 0; k < n; k += thick ? 4 : 1)
    segmentation.layers[0].insert(segmentation.layers[0].end(), mask.row(0, k), mask.row(0, k) + n * n);
  updateTissueTable(segmentation);
  for (auto _ : state) benchmark::DoNotOptimize(levelSetFromLabels(segmentation, segmentation.tissues[0]));
  state.SetItemsProcessed(state.iterations() * std::int64_t{n} * n * n);
}
BENCHMARK_CAPTURE(convertBall, cubic, false)->Apply(bench::threeSizes);

BENCHMARK_CAPTURE(convertBall, thick, true)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
