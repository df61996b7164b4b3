#include "sinew/Mesher/MoveBoundary.h"

#include "GoalMeasure.h"
#include "SurfaceProjection.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr double kTolerance = 1e-4;  // of the offset

double measureOf(const Tet& tet, const std::vector<Eigen::Vector3d>& x) {
  return goalMeasure(x[tet[3]], x[tet[0]], x[tet[1]], x[tet[2]]);
}

}  // namespace

std::vector<Eigen::Vector3d> moveBoundary(const TetMesh& mesh, const SignedDistance& phi, double offset) {
  std::vector<Eigen::Vector3d> moved = mesh.nodes;
  const SurfaceProjection onto(phi, kTolerance * std::abs(offset));
  tbb::parallel_for(std::size_t{0}, moved.size(), [&](std::size_t n) {
    if (mesh.kinds[n] != NodeKind::Boundary) return;
    // Where phi has a kink, the surface that is offset may lie elsewhere.
    constexpr double kFarthest = 2;  // offsets
    const auto x = onto(mesh.nodes[n], offset);
    if (x && (*x - mesh.nodes[n]).norm() <= kFarthest * std::abs(offset)) moved[n] = *x;
  });

  // Nodes that go back worsen other tets: these are looked for until there are none.
  std::vector<std::uint8_t> harmed(mesh.tets.size());
  for (bool some = true; some;) {
    tbb::parallel_for(std::size_t{0}, mesh.tets.size(), [&](std::size_t t) {
      const Tet& tet = mesh.tets[t];
      const bool changed =
          std::ranges::any_of(tet, [&](std::int32_t n) { return moved[n] != mesh.nodes[n]; });
      const double measure = changed ? measureOf(tet, moved) : 0;
      harmed[t] = measure > 1 && measure > measureOf(tet, mesh.nodes);
    });
    some = false;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (!harmed[t]) continue;
      some = true;
      for (const std::int32_t n : mesh.tets[t]) moved[n] = mesh.nodes[n];
    }
  }
  return moved;
}

}  // namespace sinew
