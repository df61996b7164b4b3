#include "BenchShapes.h"

namespace sinew {
namespace {

/// Items are tets of the lattice mesh.
void extractLatticeMesh(benchmark::State& state) {
  const test::AnalyticSphere phi = bench::ball(state.range(0));
  LatticePlan plan = planLattice(phi, bench::sizing());
  RedGreenLattice lattice(plan.coarseCells, plan.levels);
  refineToSize(lattice, plan, phi, bench::sizing());
  std::size_t tets = 0;
  for (auto _ : state) tets = latticeMesh(lattice, plan, phi).tets.size();
  bench::countItems(state, tets);
}
BENCHMARK(extractLatticeMesh)->Apply(bench::sizes);

void starsOfLatticeMesh(benchmark::State& state) {
  const LatticeMesh mesh = bench::background(bench::ball(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(nodeStars(mesh.positions.size(), mesh.tets));
  bench::countItems(state, mesh.tets.size());
}
BENCHMARK(starsOfLatticeMesh)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
