#include "BenchFields.h"
#include "sinew/LevelSet/ResampleLevelSet.h"
#include "sinew/LevelSet/ShapeMeasures.h"
#include "sinew/LevelSet/ShapeParts.h"
#include "sinew/LevelSet/Smooth.h"
#include "sinew/LevelSet/VoxelsInside.h"

namespace sinew {
namespace {

// What a repair script does to one shape, on a ball; items are samples of its box.

DenseLevelSet smoothed(const DenseLevelSet& ball) {
  DenseLevelSet shape = ball;
  smooth(shape, {.time = 2});
  return shape;
}
DenseLevelSet turned(const DenseLevelSet& ball) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  return resampled(ball, {}, ball.band, Eigen::Affine3d(Eigen::AngleAxisd(0.3, axis)));
}
std::vector<DenseLevelSet> piecesOf(const DenseLevelSet& ball) { return shapeComponents(ball); }
DenseLevelSet withoutHoles(const DenseLevelSet& ball) { return fillHoles(ball, 4); }
ShapeTopology topologyOf(const DenseLevelSet& ball) { return shapeTopology(ball); }
PhiAtVoxels atVoxels(const DenseLevelSet& ball) {
  return phiAtVoxels(ball, {.size = ball.phi.size / 2, .spacing = Eigen::Vector3d::Constant(2)});
}

template <typename Result>
void onBall(benchmark::State& state, Result (*operation)(const DenseLevelSet&)) {
  const DenseLevelSet ball{bench::ballDistance(static_cast<int>(state.range(0)), 4),
                           Eigen::Isometry3d::Identity(), 1, 4};
  for (auto _ : state) benchmark::DoNotOptimize(operation(ball));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.phi.values.size()));
}

BENCHMARK_CAPTURE(onBall, smooth, smoothed)->Apply(bench::threeSizes);
BENCHMARK_CAPTURE(onBall, resampled, turned)->Apply(bench::threeSizes);
BENCHMARK_CAPTURE(onBall, shapeComponents, piecesOf)->Apply(bench::threeSizes);
BENCHMARK_CAPTURE(onBall, fillHoles, withoutHoles)->Apply(bench::threeSizes);
BENCHMARK_CAPTURE(onBall, shapeTopology, topologyOf)->Apply(bench::threeSizes);
BENCHMARK_CAPTURE(onBall, phiAtVoxels, atVoxels)->Apply(bench::threeSizes);

}  // namespace
}  // namespace sinew
