#include "sinew/LevelSet/Csg.h"
#include "sinew/LevelSet/Solid.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// A ball whose box has about n^3 samples of 1 mm.
DenseLevelSet ball(const Eigen::Vector3d& center, int n) {
  const double radius = n / 2.0 - 5;
  const Solid solid = sphere(center, radius);
  return sampleSolid(solid, {}, 3, solid.bounds);
}

/// Two balls that overlap by half; items are samples of the box of the result. Arguments: n, blend in mm.
template <class Operation>
void combine(benchmark::State& state, const Operation& operation) {
  const int n = static_cast<int>(state.range(0));
  const DenseLevelSet a = ball({0, 0, 0}, n), b = ball({n / 4.0, 0, 0}, n);
  std::int64_t samples = 0;
  for (auto _ : state) {
    const DenseLevelSet result = operation(a, b, static_cast<double>(state.range(1)));
    samples += static_cast<std::int64_t>(result.phi.values.size());
    benchmark::DoNotOptimize(result.phi.values.data());
  }
  state.SetItemsProcessed(samples);
}

BENCHMARK_CAPTURE(combine, unite, unite)
    ->ArgsProduct({{64, 128, 256}, {0, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(combine, subtract, subtract)
    ->ArgsProduct({{64, 128, 256}, {0, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace sinew
