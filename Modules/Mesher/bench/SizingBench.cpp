#include "BenchShapes.h"

namespace sinew {
namespace {

/// Items are nodes of the lattice.
void refineLattice(benchmark::State& state) {
  const test::AnalyticSphere phi = bench::ball(state.range(0));
  std::int32_t nodes = 0;
  for (auto _ : state) {
    LatticePlan plan = planLattice(phi, bench::sizing());
    RedGreenLattice lattice(plan.coarseCells, plan.levels);
    refineToSize(lattice, plan, phi, bench::sizing());
    nodes = lattice.nodes().size();
  }
  bench::countItems(state, nodes);
}
BENCHMARK(refineLattice)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
