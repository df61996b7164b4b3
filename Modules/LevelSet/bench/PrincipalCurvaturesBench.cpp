#include "BenchFields.h"
#include "sinew/LevelSet/PrincipalCurvatures.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// Within two voxels of a ball; items are samples of the raster.
void curvaturesOfBall(benchmark::State& state) {
  const DenseField ball = bench::ballDistance(static_cast<int>(state.range(0)), 1e6);
  for (auto _ : state) benchmark::DoNotOptimize(principalCurvatures(ball, 1, 2.0));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.values.size()));
}

BENCHMARK(curvaturesOfBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
