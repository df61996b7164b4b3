#include "sinew/Mesher/MendCompression.h"

#include "ActiveNodes.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr int kMendedRings = 2;

}  // namespace

MendReport mendCompression(TetMesh& mesh, const SignedDistance& phi, const CompressionOptions& options,
                           const TetBounds& bounds) {
  const auto& x = mesh.nodes;
  MendReport report;
  std::vector<std::uint8_t> region(x.size());
  forEach(x.size(), [&](std::size_t n) {
    region[n] = mesh.kinds[n] == NodeKind::Boundary &&
                std::abs(phi.value(x[n])) > options.surfaceTolerance * options.edgeLength;
  });
  const auto bad = collect<Tet>(mesh.tets.size(), [&](std::size_t t, auto& found) {
    const auto& [a, b, c, d] = mesh.tets[t];
    if (bounds.exceededBy(tetQuality(x[a], x[b], x[c], x[d]))) found.push_back(mesh.tets[t]);
  });
  for (const Tet& tet : bad)
    for (const std::int32_t v : tet) region[v] = 1;
  growRings(mesh, kMendedRings, region);
  report.tets = std::ssize(bad);
  report.nodes = std::ranges::count(region, std::uint8_t{1});
  if (report.nodes > 0) report.compression = compressOntoSurface(mesh, phi, options, region);
  return report;
}

}  // namespace sinew
