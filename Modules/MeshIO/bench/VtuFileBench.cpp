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
  return {test::bccBlock(Eigen::Vector3i::Constant(static_cast<int>(state.range(0)))), {}, {}};
}

void countTets(benchmark::State& state, const TissueMesh& mesh) {
  state.SetItemsProcessed(state.iterations() * std::ssize(mesh.mesh.tets));
}

void writeVtuFile(benchmark::State& state) {
  const test::TempFolder folder;
  const TissueMesh mesh = block(state);
  for (auto _ : state) writeMesh(mesh, folder / "mesh.vtu");
  countTets(state, mesh);
}
BENCHMARK(writeVtuFile)->Apply(sizes);

void readVtuFile(benchmark::State& state) {
  const test::TempFolder folder;
  const TissueMesh mesh = block(state);
  writeMesh(mesh, folder / "mesh.vtu");
  for (auto _ : state) benchmark::DoNotOptimize(readMesh(folder / "mesh.vtu"));
  countTets(state, mesh);
}
BENCHMARK(readVtuFile)->Apply(sizes);

}  // namespace
}  // namespace sinew
