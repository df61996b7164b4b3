#include "BenchShapes.h"
#include "sinew/Mesher/Compression.h"

namespace sinew {
namespace {

void compressBall(benchmark::State& state) {
  const test::AnalyticSphere phi = bench::ball(state.range(0));
  const TetMesh candidate = bench::candidateMesh(phi);
  for (auto _ : state) {
    state.PauseTiming();
    TetMesh mesh = candidate;
    state.ResumeTiming();
    compressOntoSurface(mesh, phi, {.edgeLength = bench::kEdgeLength});
  }
  bench::countItems(state, candidate.tets.size());
}
BENCHMARK(compressBall)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
