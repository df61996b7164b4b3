#include "BenchFields.h"
#include "sinew/LevelSet/Reinitialize.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// Half width 3 voxels on a ball whose field has a slope of 1.5; items are samples of the raster.
void reinitializeBall(benchmark::State& state) {
  DenseField ball = bench::ballDistance(static_cast<int>(state.range(0)), 1e6);
  for (float& v : ball.values) v *= 1.5F;
  for (auto _ : state) {
    state.PauseTiming();
    DenseField phi = ball;
    state.ResumeTiming();
    reinitialize(phi, 1, 3);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.values.size()));
}

BENCHMARK(reinitializeBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
