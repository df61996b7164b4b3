#include "sinew/MeshIO/QuadraticMesh.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/LatticeMesh.h"
#include "sinew/TestSupport/TempFolder.h"

#include <benchmark/benchmark.h>

namespace sinew {
namespace {

/// About 11 thousand, 92 thousand and 760 thousand tets.
void sizes(benchmark::internal::Benchmark* bench) {
  bench->Arg(10)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond);
}

TissueMesh block(const benchmark::State& state) {
  const auto cubes = static_cast<int>(state.range(0));
  return {test::bccBlock(Eigen::Vector3i::Constant(cubes)), {{1, "block"}}, {}};
}

void countTets(benchmark::State& state, const TissueMesh& mesh) {
  state.SetItemsProcessed(state.iterations() * std::ssize(mesh.mesh.tets));
}

void write(benchmark::State& state, const char* extension, bool quadratic) {
  const test::TempFolder folder;
  const TissueMesh mesh = block(state);
  for (auto _ : state) writeMesh(mesh, folder / (std::string("mesh") + extension), {.quadratic = quadratic});
  countTets(state, mesh);
}
BENCHMARK_CAPTURE(write, msh, ".msh", false)->Apply(sizes);
BENCHMARK_CAPTURE(write, inp, ".inp", false)->Apply(sizes);
BENCHMARK_CAPTURE(write, feb, ".feb", false)->Apply(sizes);
BENCHMARK_CAPTURE(write, exo, ".exo", false)->Apply(sizes);
BENCHMARK_CAPTURE(write, quadraticInp, ".inp", true)->Apply(sizes);

void readMsh(benchmark::State& state) {
  const test::TempFolder folder;
  const TissueMesh mesh = block(state);
  writeMesh(mesh, folder / "mesh.msh");
  for (auto _ : state) benchmark::DoNotOptimize(readMesh(folder / "mesh.msh"));
  countTets(state, mesh);
}
BENCHMARK(readMsh)->Apply(sizes);

void bendBoundary(benchmark::State& state) {
  const TissueMesh mesh = block(state);
  for (auto _ : state) benchmark::DoNotOptimize(curveBoundary(mesh.mesh));
  countTets(state, mesh);
}
BENCHMARK(bendBoundary)->Apply(sizes);

}  // namespace
}  // namespace sinew
