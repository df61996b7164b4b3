#pragma once

#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/Sizing.h"
#include "sinew/TestSupport/AnalyticDistance.h"

#include <benchmark/benchmark.h>

namespace sinew::bench {

inline constexpr double kEdgeLength = 1;  // mm; shapes are measured in cubes of this size
inline constexpr test::AnalyticOptions kSampling{.resolution = 0.5, .band = 2.5};  // mm, as from voxels

inline test::AnalyticSphere ball(std::int64_t cubesAcross) {
  return {Eigen::Vector3d(0.1, 0.2, 0.3), 0.5 * kEdgeLength * static_cast<double>(cubesAcross), kSampling};
}

/// A ring with a tube a third as thick as the ring is wide.
inline test::AnalyticTorus ring(std::int64_t cubesAcross) {
  const double outer = 0.5 * kEdgeLength * static_cast<double>(cubesAcross);
  return {Eigen::Vector3d(0.1, 0.2, 0.3), outer * 2 / 3, outer / 3, kSampling};
}

inline SizingOptions sizing() {
  return {.edgeLength = kEdgeLength, .maxEdgeLength = 8 * kEdgeLength, .minEdgeLength = kSampling.resolution};
}

/// The lattice mesh of a shape.
inline LatticeMesh background(const SignedDistance& phi) {
  LatticePlan plan = planLattice(phi, sizing());
  RedGreenLattice lattice(plan.coarseCells, plan.levels);
  refineToSize(lattice, plan, phi, sizing());
  return latticeMesh(lattice, plan, phi);
}

/// The candidate mesh of a shape.
inline TetMesh candidateMesh(const SignedDistance& phi) {
  const LatticeMesh mesh = background(phi);
  const Candidate candidate = selectCandidate(mesh, nodeStars(mesh.positions.size(), mesh.tets));
  return extractMesh(mesh, candidate.keep, 1);
}

/// About 5, 40 and 200 thousand tets of a ball, by cubes across.
inline void sizes(benchmark::internal::Benchmark* bench) {
  bench->Arg(10)->Arg(20)->Arg(40)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

/// @param items  per iteration
template <class Count>
void countItems(benchmark::State& state, Count items) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
}

}  // namespace sinew::bench
