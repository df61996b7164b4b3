#include "QualityArrays.h"

#include "sinew/Mesher/MeshQuality.h"

#include <tbb/parallel_for.h>

namespace sinew {

MeshArrays qualityArrays(const TetMesh& mesh, const SignedDistance& surface, const Eigen::Isometry3d& frame) {
  const std::size_t tets = mesh.tets.size(), nodes = mesh.nodes.size();
  std::vector<float> aspectRatio(tets), smallest(tets), largest(tets), phi(nodes);
  tbb::parallel_for(std::size_t{0}, tets, [&](std::size_t t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const TetQuality quality = tetQuality(mesh.nodes[a], mesh.nodes[b], mesh.nodes[c], mesh.nodes[d]);
    aspectRatio[t] = static_cast<float>(quality.aspectRatio);
    smallest[t] = static_cast<float>(quality.minDihedralDeg);
    largest[t] = static_cast<float>(quality.maxDihedralDeg);
  });
  const Eigen::Isometry3d toSurface = frame.inverse();
  tbb::parallel_for(std::size_t{0}, nodes, [&](std::size_t n) {
    phi[n] = static_cast<float>(surface.value(toSurface * mesh.nodes[n]));
  });
  MeshArrays arrays;
  arrays.cells = {{"aspect_ratio", std::move(aspectRatio)},
                  {"min_dihedral_deg", std::move(smallest)},
                  {"max_dihedral_deg", std::move(largest)}};
  arrays.points = {{"phi", std::move(phi)}};
  return arrays;
}

}  // namespace sinew
