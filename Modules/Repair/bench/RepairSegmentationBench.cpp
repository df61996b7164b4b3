#include "sinew/Repair/RepairSegmentation.h"
#include "sinew/Segmentation/Phantom.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

constexpr const char* kTwentyOperations = R"(
local biceps, humerus, triceps = tissue "biceps", tissue "humerus", tissue "triceps"
local c = centroid(biceps)
local function at(x, y, z) return {c[1] + x, c[2] + y, c[3] + z} end
biceps = biceps - sphere{center=c, radius=5}
biceps = biceps + capsule{from=at(0, 0, -20), to=at(0, 0, 20), radius=8, blend=2}
biceps = (biceps - humerus:offset(1)):smooth{time=1, preserve="volume"}
biceps = biceps:opening(2):closing(2):keep_largest():fill_cavities()
triceps = triceps * halfspace{point=c, normal={0, 0, 1}} + triceps * halfspace{point=c, normal={0, 0, -1}}
triceps = (triceps - biceps):drop_small(20):fill_holes(2):smooth{sigma=1}
humerus = humerus + humerus:translate{0, 0, 4} + humerus:rotate{axis={0, 0, 1}, degrees=3}
save("biceps", biceps)
save("triceps", triceps)
save("humerus", humerus)
)";

/// Twenty operations on three tissues of the phantom of an arm; items are voxels of the image.
void repairArm(benchmark::State& state) {
  const double spacing = 8. / static_cast<double>(state.range(0));
  const Segmentation arm = makePhantom("upper-arm", {.spacing = Eigen::Vector3d::Constant(spacing)});
  for (auto _ : state) benchmark::DoNotOptimize(repairSegmentation(arm, kTwentyOperations));
  state.SetItemsProcessed(state.iterations() * arm.geometry.voxelCount());
}
// 8 mm over the voxel size.
BENCHMARK(repairArm)
    ->Arg(2)
    ->Arg(4)
    ->Arg(8)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

/// What the sandbox takes for a script without shapes; items are instructions of Lua, about.
void runLoop(benchmark::State& state) {
  const Segmentation arm = makePhantom("upper-arm", {.spacing = Eigen::Vector3d::Constant(8)});
  const std::string script =
      "local n = 0\nfor i = 1, " + std::to_string(state.range(0)) + " do n = n + i end";
  for (auto _ : state) benchmark::DoNotOptimize(repairSegmentation(arm, script, {.check = true}));
  state.SetItemsProcessed(state.iterations() * 2 * state.range(0));
}
BENCHMARK(runLoop)->Arg(1'000)->Arg(100'000)->Arg(10'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sinew
