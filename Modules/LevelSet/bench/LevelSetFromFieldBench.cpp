#include "BenchFields.h"
#include "sinew/LevelSet/LevelSetFromField.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

void copyBall(benchmark::State& state) {
  const DenseField ball = bench::ballDistance(static_cast<int>(state.range(0)), 3);
  for (auto _ : state)
    benchmark::DoNotOptimize(levelSetFromField({ball, Eigen::Isometry3d::Identity(), 1, 3}));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.values.size()));
}

BENCHMARK(copyBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
