#include "BenchFields.h"
#include "sinew/LevelSet/SliceInterpolation.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// Four planes per slice; items are samples of the result.
void interpolateBallSlices(benchmark::State& state) {
  const DenseField slices = bench::ballSlices(static_cast<int>(state.range(0)));
  std::vector<double> positions;
  for (int n = 0; n <= 4 * (slices.size.z() - 1); ++n) positions.push_back(n / 4.0);
  for (auto _ : state) benchmark::DoNotOptimize(interpolateSlices(slices, 4, positions, 5));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(positions.size()) * slices.size.x() *
                          slices.size.y());
}

BENCHMARK(interpolateBallSlices)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
