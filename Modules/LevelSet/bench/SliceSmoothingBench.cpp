#include "BenchFields.h"
#include "sinew/LevelSet/SliceSmoothing.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

void smoothBallSlices(benchmark::State& state) {
  const DenseField slices = bench::ballSlices(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    DenseField field = slices;
    state.ResumeTiming();
    smoothAcrossSlices(field, 1);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(slices.values.size()));
}

BENCHMARK(smoothBallSlices)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
