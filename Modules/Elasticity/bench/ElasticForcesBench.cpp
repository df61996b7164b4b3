#include "sinew/Elasticity/ElasticForces.h"
#include "sinew/Elasticity/Muscle.h"
#include "sinew/Elasticity/Newmark.h"
#include "sinew/Elasticity/Springs.h"
#include "sinew/Elasticity/StrainLimits.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// A bar of about as many tets as the range says, a little deformed.
struct Bar {
  ElasticBody body;
  NodeVectors places;

  explicit Bar(const benchmark::State& state) {
    const int cubes = static_cast<int>(std::cbrt(static_cast<double>(state.range(0)) / 6));
    body = elasticBody(test::barMesh({cubes, cubes, cubes}, 1));
    places = test::shaken(body.rest, 0.05, 1);
  }
};

/// CPU time of all threads.
void sizes(benchmark::internal::Benchmark* bench) {
  bench->Arg(10'000)->Arg(50'000)->Arg(200'000)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}

void countTets(benchmark::State& state, const Bar& bar, double updates = 1) {
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(updates * static_cast<double>(bar.body.tets.size())));
}

template <std::unique_ptr<Material> (*law)(const Lame&)>
void forcesOf(benchmark::State& state) {
  const Bar bar(state);
  const auto material = law(lame(30, 0.4));
  NodeVectors forces(bar.body.nodeCount(), Eigen::Vector3d::Zero());
  for (auto _ : state) addElasticForces(bar.body, *material, bar.places, forces);
  countTets(state, bar);
}
BENCHMARK(forcesOf<stVenantKirchhoff>)->Apply(sizes);
BENCHMARK(forcesOf<neoHookean>)->Apply(sizes);
BENCHMARK(forcesOf<corotated>)->Apply(sizes);

constexpr double kTolerance = 0.05;  // of the conjugate gradients in compression by physics

/// One step with all that it does, with the tolerance of compression's conjugate gradients. Two rates are counted:
/// `stepped`, the tets of the body per CPU second of whole steps (a tet counts once in a step, whatever is done to
/// it), and `items`, the updates: evaluations of a tet's forces (two in a step) or of its damping forces, if it has
/// any (three and one for each iteration of the conjugate gradients).
template <bool damped, class Make>
void steps(benchmark::State& state, const Make& make) {
  Bar bar(state);
  const auto forces = make(bar.body);
  const NodeConstraints constraints(bar.body.nodeCount());
  Motion motion{bar.places, NodeVectors(bar.body.nodeCount(), Eigen::Vector3d::Zero())};
  double updates = 0;
  for (auto _ : state) {
    const NewmarkReport report =
        newmarkStep(bar.body, *forces, constraints, 1e-6, motion, {.tolerance = kTolerance});
    updates += 2;                                  // forces
    if (damped) updates += 3 + report.iterations;  // starting residuals and D v; iterations
  }
  const auto tets = static_cast<double>(bar.body.tets.size());
  state.SetItemsProcessed(static_cast<std::int64_t>(updates * tets));
  state.counters["stepped"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * tets, benchmark::Counter::kIsRate);
}

/// With or without damping inside of tets; compression by physics has none by default.
template <bool damped>
void newmarkFiniteElements(benchmark::State& state) {
  const auto material = neoHookean(lame(30, 0.4));
  const double viscosity = damped ? 0.01 : 0;  // kPa s
  steps<damped>(state, [&](const ElasticBody& body) {
    return std::make_unique<FiniteElements>(body, *material, Damping{.alpha = viscosity, .beta = viscosity});
  });
}
BENCHMARK(newmarkFiniteElements<true>)->Apply(sizes);
BENCHMARK(newmarkFiniteElements<false>)->Apply(sizes);

template <bool damped>
void newmarkAltitudeSprings(benchmark::State& state) {
  steps<damped>(state, [](const ElasticBody& body) {
    return std::make_unique<AltitudeSprings>(body,
                                             AltitudeSpringOptions{.springs = {.damping = damped ? 0.1 : 0}});
  });
}
BENCHMARK(newmarkAltitudeSprings<true>)->Apply(sizes);
BENCHMARK(newmarkAltitudeSprings<false>)->Apply(sizes);

template <bool damped>
void newmarkEdgeSprings(benchmark::State& state) {
  steps<damped>(state, [](const ElasticBody& body) {
    return std::make_unique<EdgeSprings>(body, SpringOptions{.damping = damped ? 0.1 : 0});
  });
}
BENCHMARK(newmarkEdgeSprings<true>)->Apply(sizes);
BENCHMARK(newmarkEdgeSprings<false>)->Apply(sizes);

void strainLimits(benchmark::State& state) {
  const Bar bar(state);
  const StrainLimits limits(bar.body, {.sweeps = 1});
  const NodeConstraints constraints(bar.body.nodeCount());
  const NodeVectors start = test::randomVectors(bar.body.nodeCount(), 10, 1);
  for (auto _ : state) {
    NodeVectors velocities = start;
    benchmark::DoNotOptimize(limits.apply(constraints, bar.places, 0.01, velocities));
  }
  countTets(state, bar);
}
BENCHMARK(strainLimits)->Apply(sizes);

}  // namespace
}  // namespace sinew
