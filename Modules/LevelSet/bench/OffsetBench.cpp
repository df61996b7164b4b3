#include "sinew/LevelSet/Offset.h"
#include "sinew/LevelSet/Solid.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// A ball whose box has about n^3 samples of 1 mm, moved by the second argument, mm; items are samples of the
/// result.
void offsetBall(benchmark::State& state) {
  const Solid solid = sphere({0, 0, 0}, static_cast<double>(state.range(0)) / 2.0 - 5);
  const DenseLevelSet ball = sampleSolid(solid, {}, 3, solid.bounds);
  std::int64_t samples = 0;
  for (auto _ : state) {
    const DenseLevelSet result = offset(ball, static_cast<double>(state.range(1)));
    samples += static_cast<std::int64_t>(result.phi.values.size());
    benchmark::DoNotOptimize(result.phi.values.data());
  }
  state.SetItemsProcessed(samples);
}

BENCHMARK(offsetBall)
    ->ArgsProduct({{64, 128, 256}, {-2, 2, 8}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace sinew
