#include "BenchFields.h"
#include "sinew/LevelSet/Solid.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace sinew {
namespace {

/// A shape of about n mm on samples of 1 mm; items are samples of the box.
void sample(benchmark::State& state, Solid (*solidOf)(double n)) {
  const Solid solid = solidOf(static_cast<double>(state.range(0)));
  std::int64_t samples = 0;
  for (auto _ : state) {
    const DenseLevelSet result = sampleSolid(solid, {}, 3, solid.bounds);
    samples += static_cast<std::int64_t>(result.phi.values.size());
    benchmark::DoNotOptimize(result.phi.values.data());
  }
  state.SetItemsProcessed(samples);
}

Solid capsuleOf(double n) { return capsule({0, 0, 0}, {0.5 * n, 0.5 * n, 0.5 * n}, n / 4); }
Solid eggOf(double n) { return ellipsoid({0, 0, 0}, {n / 2, n / 3, n / 4}); }
Solid helixOf(double n) {
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < 50; ++k)
    points.emplace_back(n / 3 * std::cos(0.3 * k), n / 3 * std::sin(0.3 * k), n * k / 50);
  return tube(points, {n / 16});
}

BENCHMARK_CAPTURE(sample, capsule, capsuleOf)->Apply(bench::threeSizes);
BENCHMARK_CAPTURE(sample, ellipsoid, eggOf)->Apply(bench::threeSizes);
BENCHMARK_CAPTURE(sample, tubeOf50Points, helixOf)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
