#include "sinew/Elasticity/Equilibrium.h"
#include "sinew/Elasticity/Muscle.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// From rest to the balance of a spindle of muscle at a fifth of its activation, held at both ends. Items are tets;
/// the label counts steps of Newton and of conjugate gradients.
void contractedMuscle(benchmark::State& state) {
  const int across = static_cast<int>(std::cbrt(static_cast<double>(state.range(0)) / 18)),
            length = 3 * across;
  const ElasticBody body = elasticBody(test::spindleMesh({across, across, length}, 1));
  NodeConstraints constraints(body.nodeCount());
  for (std::size_t n = 0; n < body.nodeCount(); ++n)
    if (body.rest[n].z() < 0.5 || body.rest[n].z() > length - 0.5) constraints.freedom[n] = NodeFreedom::Held;
  Muscle muscle(std::vector<MuscleFibre>(body.tets.size()));
  muscle.activate(0.2);
  EquilibriumReport report;
  for (auto _ : state) {
    NodeVectors places = body.rest;
    report = findEquilibrium(body, muscle, constraints, {}, places, {.tolerance = 1e-4});
  }
  state.SetLabel(std::to_string(report.steps) + " Newton, " + std::to_string(report.cgIterations) + " CG" +
                 (report.converged ? "" : ", no balance"));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(body.tets.size()));
}
BENCHMARK(contractedMuscle)->Arg(10'000)->Arg(50'000)->Arg(200'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sinew
