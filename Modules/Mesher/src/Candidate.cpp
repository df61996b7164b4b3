#include "sinew/Mesher/Candidate.h"

#include "KeptSet.h"
#include "Parallel.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace sinew {
namespace {

std::vector<std::uint8_t> envelopeInteriorNodes(const LatticeMesh& mesh, const NodeStars& stars,
                                                double minInsideFraction) {
  const double ratio = (1 - minInsideFraction) / minInsideFraction;
  std::vector<std::uint8_t> enveloped(mesh.phi.size());
  forEach(enveloped.size(), [&](std::size_t n) {
    const double phi = mesh.phi[n];
    enveloped[n] =
        phi < 0 && std::ranges::all_of(stars.of(static_cast<std::int32_t>(n)), [&](std::int32_t t) {
          return std::ranges::all_of(mesh.tets[t],
                                     [&](std::int32_t v) { return mesh.phi[v] <= -ratio * phi; });
        });
  });
  return enveloped;
}

}  // namespace

Candidate selectCandidate(const LatticeMesh& mesh, const NodeStars& stars, const CandidateOptions& options) {
  KeptSet set(mesh, stars, envelopeInteriorNodes(mesh, stars, options.minInsideFraction));
  std::vector<std::int32_t> all(mesh.phi.size());
  std::iota(all.begin(), all.end(), 0);
  const Enveloped repair = envelopeViolations(set, all, options.maxPasses);
  Candidate candidate;
  candidate.violations = repair.violations;
  if (repair.violations > 0 && options.maxPasses > 0) {
    candidate.released = std::ssize(releaseViolations(set, std::move(all)));
    candidate.violations = 0;
  }
  candidate.enveloped = set.enveloped();
  candidate.keep = set.keep();
  candidate.passes = repair.passes;
  candidate.added = static_cast<std::int64_t>(repair.nodes.size());
  return candidate;
}

TetMesh extractMesh(const LatticeMesh& mesh, const std::vector<std::uint8_t>& keep, std::int32_t label,
                    std::vector<std::int32_t>* latticeNodes) {
  std::vector<std::uint8_t> kept(mesh.positions.size(), 0), partial(mesh.positions.size(), 0);
  forEach(mesh.tets.size(), [&](std::size_t t) {
    for (const std::int32_t v : mesh.tets[t]) setFlag((keep[t] != 0 ? kept : partial)[v]);
  });
  const std::vector<std::int32_t> nodes = collect<std::int32_t>(kept.size(), [&](std::size_t n, auto& found) {
    if (kept[n] != 0) found.push_back(static_cast<std::int32_t>(n));
  });
  std::vector<std::int32_t> compact(mesh.positions.size(), kNone);
  TetMesh result;
  result.nodes.resize(nodes.size());
  result.kinds.resize(nodes.size());
  forEach(nodes.size(), [&](std::size_t n) {
    compact[nodes[n]] = static_cast<std::int32_t>(n);
    result.nodes[n] = mesh.positions[nodes[n]];
    result.kinds[n] = partial[nodes[n]] != 0 ? NodeKind::Boundary : NodeKind::Interior;
  });
  result.tets = collect<Tet>(mesh.tets.size(), [&](std::size_t t, auto& tets) {
    if (keep[t] == 0) return;
    const auto& [a, b, c, d] = mesh.tets[t];
    tets.push_back({compact[a], compact[b], compact[c], compact[d]});
  });
  result.labels.assign(result.tets.size(), label);
  if (latticeNodes != nullptr) *latticeNodes = nodes;
  return result;
}

}  // namespace sinew
