#include "RepairSpot.h"

#include "GoalMeasure.h"
#include "Parallel.h"
#include "sinew/Mesher/MeshQuality.h"

namespace sinew {
namespace {

/// Beyond these a tet is worth a trial to mend it, and beyond the second ones it must go.
struct Limits {
  double aspectRatio, minDihedralDeg, maxDihedralDeg;

  bool exceededBy(const TetQuality& q) const {
    return q.aspectRatio > aspectRatio || q.minDihedralDeg < minDihedralDeg ||
           q.maxDihedralDeg > maxDihedralDeg;
  }
};
constexpr Limits kBad{3.5, 25, 140}, kGrave{4.2, 20, 142};

}  // namespace

std::vector<Spot> repairSpots(const TetMesh& mesh, const std::vector<std::int32_t>& latticeNodes,
                              const std::vector<std::int32_t>& unsnapped) {
  const auto& x = mesh.nodes;
  const std::vector<Spot> bad = collect<Spot>(mesh.tets.size(), [&](std::size_t t, auto& found) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const double measure = goalMeasure(mesh.tets[t], x);
    if (measure <= 1) return;
    const TetQuality quality = tetQuality(x[a], x[b], x[c], x[d]);
    if (!kBad.exceededBy(quality)) return;
    found.push_back({{latticeNodes[a], latticeNodes[b], latticeNodes[c], latticeNodes[d]},
                     measure,
                     kGrave.exceededBy(quality)});
  });
  std::vector<Spot> spots;
  for (const std::int32_t n : unsnapped) spots.push_back({{latticeNodes[n]}, kInfinity, true});
  spots.insert(spots.end(), bad.begin(), bad.end());
  return spots;
}

}  // namespace sinew
