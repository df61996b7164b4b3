#include "BenchFields.h"
#include "sinew/LevelSet/GaussianSmoothing.h"
#include "sinew/LevelSet/SurfaceLevel.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

void levelBall(benchmark::State& state) {
  const DenseMask mask = bench::ballMask(static_cast<int>(state.range(0)));
  const DenseField smooth = gaussianSmoothing(mask, Eigen::Vector3d::Ones());
  for (auto _ : state) {
    state.PauseTiming();
    DenseField field = smooth;
    state.ResumeTiming();
    subtractSurfaceLevel(field, mask, Eigen::Vector3d::Ones(), 0.49);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mask.values.size()));
}

BENCHMARK(levelBall)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
