#include "TissueSurfaces.h"

#include "SolverMesh.h"

#include <algorithm>

namespace sinew {
namespace {

TriangleMesh surfaceOf(const SolverMesh& mesh, const SolverPart& part) {
  TriangleMesh surface;
  for (const std::int32_t node : part.boundaryNodes)
    surface.nodes.push_back(mesh.node(static_cast<std::size_t>(node)));
  const auto place = [&](std::int32_t node) {
    const auto found = std::ranges::lower_bound(part.boundaryNodes, node);
    return static_cast<std::int32_t>(found - part.boundaryNodes.begin());
  };
  for (const TetFace& face : part.boundary) {
    const FaceNodes nodes = mesh.face(face);
    const auto* corner = nodes.begin();
    surface.triangles.push_back({place(corner[0]), place(corner[1]), place(corner[2])});
  }
  return surface;
}

}  // namespace

std::vector<TissueSurface> tissueSurfaces(const TissueMesh& mesh, const WriteMeshOptions& options) {
  WriteMeshOptions linear = options;
  linear.quadratic = false;
  const SolverMesh solverMesh(mesh, linear);
  std::vector<TissueSurface> surfaces;
  for (const SolverPart& part : solverMesh.parts())
    surfaces.push_back({part.region, surfaceOf(solverMesh, part)});
  return surfaces;
}

}  // namespace sinew
