#include "BenchShapes.h"
#include "sinew/Mesher/GenerateTetMesh.h"

namespace sinew {
namespace {

/// From phi to the finished mesh; items are its tets.
void generate(benchmark::State& state, const SignedDistance& phi) {
  GenerateTetMeshOptions options;
  options.edgeLength = bench::kEdgeLength;
  std::size_t tets = 0;
  for (auto _ : state) tets = generateTetMesh(phi, options).tets.size();
  bench::countItems(state, tets);
}

void generateBall(benchmark::State& state) { generate(state, bench::ball(state.range(0))); }
BENCHMARK(generateBall)->Apply(bench::sizes);

void generateRing(benchmark::State& state) { generate(state, bench::ring(state.range(0))); }
BENCHMARK(generateRing)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
