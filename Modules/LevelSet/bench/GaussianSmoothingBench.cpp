#include "BenchFields.h"
#include "sinew/LevelSet/GaussianSmoothing.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

void smoothBall(benchmark::State& state) {
  const DenseMask mask = bench::ballMask(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(gaussianSmoothing(mask, Eigen::Vector3d::Ones()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mask.values.size()));
}

BENCHMARK(smoothBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
