#include "sinew/Mesher/MoveBoundary.h"

#include "GoalMeasure.h"
#include "Parallel.h"
#include "SurfaceProjection.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr double kTolerance = 1e-4;  // of the offset

}  // namespace

std::vector<Eigen::Vector3d> moveBoundary(const TetMesh& mesh, const SignedDistance& phi, double offset) {
  std::vector<Eigen::Vector3d> moved = mesh.nodes;
  const SurfaceProjection onto(phi, kTolerance * std::abs(offset));
  forEach(moved.size(), [&](std::size_t n) {
    if (mesh.kinds[n] != NodeKind::Boundary) return;
    // Where phi has a kink, the surface that is offset may lie elsewhere.
    constexpr double kFarthest = 2;  // offsets
    const auto x = onto(mesh.nodes[n], offset);
    if (x && (*x - mesh.nodes[n]).norm() <= kFarthest * std::abs(offset)) moved[n] = *x;
  });

  // Nodes that go back worsen other tets: these are looked for until there are none.
  while (true) {
    const auto harmed = collect<Tet>(mesh.tets.size(), [&](std::size_t t, auto& found) {
      const Tet& tet = mesh.tets[t];
      if (std::ranges::all_of(tet, [&](std::int32_t n) { return moved[n] == mesh.nodes[n]; })) return;
      const double measure = goalMeasure(tet, moved);
      if (measure > 1 && measure > goalMeasure(tet, mesh.nodes)) found.push_back(tet);
    });
    if (harmed.empty()) return moved;
    for (const Tet& tet : harmed)
      for (const std::int32_t n : tet) moved[n] = mesh.nodes[n];
  }
}

}  // namespace sinew
