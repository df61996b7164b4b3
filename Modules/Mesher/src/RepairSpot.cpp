#include "RepairSpot.h"

#include "GoalMeasure.h"
#include "Parallel.h"

namespace sinew {

std::vector<Spot> repairSpots(const TetMesh& mesh, const std::vector<std::int32_t>& latticeNodes,
                              const std::vector<std::int32_t>& unsnapped, const RepairBounds& bounds) {
  const auto& x = mesh.nodes;
  const std::vector<Spot> bad = collect<Spot>(mesh.tets.size(), [&](std::size_t t, auto& found) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const double measure = goalMeasure(mesh.tets[t], x);
    if (measure <= 1) return;
    const TetQuality quality = tetQuality(x[a], x[b], x[c], x[d]);
    if (!bounds.bad.exceededBy(quality)) return;
    found.push_back({{latticeNodes[a], latticeNodes[b], latticeNodes[c], latticeNodes[d]},
                     measure,
                     bounds.grave.exceededBy(quality)});
  });
  std::vector<Spot> spots;
  for (const std::int32_t n : unsnapped) spots.push_back({{latticeNodes[n]}, kInfinity, true});
  spots.insert(spots.end(), bad.begin(), bad.end());
  return spots;
}

}  // namespace sinew
