#include "ActiveNodes.h"
#include "BenchShapes.h"
#include "NodeStarEnergy.h"

namespace sinew {
namespace {

constexpr int kExponent = 4;  // of F, as in the middle of a compression

/// One sweep over the stars of the movable nodes of a candidate; items are tets evaluated.
template <class Evaluate>
void sweepStars(benchmark::State& state, const Evaluate& evaluate) {
  const TetMesh mesh = bench::candidateMesh(bench::ball(state.range(0)));
  const ActiveNodes active = activeNodes(mesh, movableNodes(mesh));
  NodeStar star;
  for (auto _ : state) {
    double sum = 0;
    for (std::size_t a = 0; a < active.size(); ++a) {
      star.gather(active.star(static_cast<std::int32_t>(a)), mesh.nodes, mesh.nodes[active.nodes[a]]);
      sum += evaluate(star);
    }
    benchmark::DoNotOptimize(sum);
  }
  bench::countItems(state, active.faces.size());
}

void gatherStars(benchmark::State& state) {
  sweepStars(state, [](const NodeStar& star) { return star.origin().x(); });
}
BENCHMARK(gatherStars)->Apply(bench::sizes);

void valueOfStars(benchmark::State& state) {
  sweepStars(state, [](const NodeStar& star) { return star.value(star.origin(), kExponent).energy; });
}
BENCHMARK(valueOfStars)->Apply(bench::sizes);

void derivativesOfStars(benchmark::State& state) {
  sweepStars(state, [](const NodeStar& star) {
    const StarDerivatives derivatives = star.derivatives(kExponent);
    return derivatives.gradient.sum() + derivatives.hessian.trace();
  });
}
BENCHMARK(derivativesOfStars)->Apply(bench::sizes);

}  // namespace
}  // namespace sinew
