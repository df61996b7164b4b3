#include "BenchFields.h"
#include "sinew/LevelSet/FastMarching.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// Half width 3 voxels on a ball; items are samples of the raster.
void marchBall(benchmark::State& state) {
  const DenseField ball = bench::ballDistance(static_cast<int>(state.range(0)), 1e6);
  for (auto _ : state) {
    state.PauseTiming();
    DenseField phi = ball;
    state.ResumeTiming();
    fastMarching(phi, Eigen::Vector3d::Ones(), 3);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.values.size()));
}

BENCHMARK(marchBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
