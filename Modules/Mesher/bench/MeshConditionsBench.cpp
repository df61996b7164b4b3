#include "BenchShapes.h"
#include "sinew/Mesher/MeshConditions.h"

namespace sinew {
namespace {

/// Items are tets.
template <class Measure>
void measureCandidate(benchmark::State& state, const Measure& measure) {
  const TetMesh mesh = bench::candidateMesh(bench::ball(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(measure(mesh));
  bench::countItems(state, mesh.tets.size());
}

void conditionsOfCandidate(benchmark::State& state) {
  measureCandidate(state, [](const TetMesh& mesh) { return meshConditions(mesh); });
}
BENCHMARK(conditionsOfCandidate)->Apply(bench::sizes);

void topologyOfCandidate(benchmark::State& state) {
  measureCandidate(state, [](const TetMesh& mesh) { return meshTopology(mesh); });
}
BENCHMARK(topologyOfCandidate)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
