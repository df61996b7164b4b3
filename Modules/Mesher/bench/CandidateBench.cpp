#include "BenchShapes.h"

namespace sinew {
namespace {

/// Items are tets of the lattice mesh.
void selectFromLattice(benchmark::State& state) {
  const LatticeMesh mesh = bench::background(bench::ball(state.range(0)));
  const NodeStars stars = nodeStars(mesh.positions.size(), mesh.tets);
  for (auto _ : state) benchmark::DoNotOptimize(selectCandidate(mesh, stars));
  bench::countItems(state, mesh.tets.size());
}
BENCHMARK(selectFromLattice)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
