#include "BenchShapes.h"
#include "sinew/Mesher/MeshQuality.h"

namespace sinew {
namespace {

void qualityOfCandidate(benchmark::State& state) {
  const TetMesh mesh = bench::candidateMesh(bench::ball(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(meshQuality(mesh));
  bench::countItems(state, mesh.tets.size());
}
BENCHMARK(qualityOfCandidate)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
