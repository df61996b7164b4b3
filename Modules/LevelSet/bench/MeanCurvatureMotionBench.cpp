#include "BenchFields.h"
#include "sinew/LevelSet/MeanCurvatureMotion.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// Two voxels^2 on a ball, twelve steps; items are samples of the raster.
void shrinkBall(benchmark::State& state) {
  const DenseField ball = bench::ballDistance(static_cast<int>(state.range(0)), 4);
  for (auto _ : state) {
    state.PauseTiming();
    DenseField phi = ball;
    state.ResumeTiming();
    meanCurvatureMotion(phi, 1, 2, 4);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.values.size()));
}

BENCHMARK(shrinkBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
