#include "WorstElements.h"

namespace sinew {

std::vector<WorstElement> worstElements(const TetMesh& mesh, const MeshQuality& quality) {
  const std::pair<const char*, const std::vector<RankedTet>&> rankings[]{
      {"aspect_ratio", quality.largestAspectRatios},
      {"min_dihedral_deg", quality.smallestDihedrals},
      {"max_dihedral_deg", quality.largestDihedrals}};
  std::vector<WorstElement> worst;
  for (const auto& [measure, ranking] : rankings)
    for (const auto& [tet, value] : ranking) {
      const auto& [a, b, c, d] = mesh.tets[tet];
      worst.push_back(
          {measure, tet, value, (mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c] + mesh.nodes[d]) / 4});
    }
  return worst;
}

}  // namespace sinew
