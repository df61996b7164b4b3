#include "BenchFields.h"
#include "sinew/LevelSet/SliceDistances.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

void distancesOfBallSlices(benchmark::State& state) {
  const DenseField ball = bench::ballDistance(static_cast<int>(state.range(0)), 1e6);
  for (auto _ : state) {
    state.PauseTiming();
    DenseField field = ball;
    state.ResumeTiming();
    sliceDistances(field, {1, 1}, 64);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.values.size()));
}

BENCHMARK(distancesOfBallSlices)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
