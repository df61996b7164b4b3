#include "BenchFields.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetMeasures.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

LevelSet ball(int n) {
  return levelSetFromField({bench::ballDistance(n, 3), Eigen::Isometry3d::Identity(), 1, 3});
}

void volumeOfBall(benchmark::State& state) {
  const LevelSet levelSet = ball(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(levelSetVolume(levelSet));
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0) * state.range(0));
}
BENCHMARK(volumeOfBall)->Apply(bench::threeSizes);

void topologyOfBall(benchmark::State& state) {
  const LevelSet levelSet = ball(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(levelSetTopology(levelSet));
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0) * state.range(0));
}

BENCHMARK(topologyOfBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
