#include "sinew/Mesher/Candidate.h"

#include "KeptSet.h"

#include <iterator>
#include <numeric>
#include <utility>

namespace sinew {
namespace {

std::vector<std::uint8_t> envelopeInteriorNodes(const LatticeMesh& mesh, double minInsideFraction) {
  const double ratio = (1 - minInsideFraction) / minInsideFraction;
  std::vector<std::uint8_t> enveloped(mesh.phi.size());
  for (std::size_t n = 0; n < mesh.phi.size(); ++n) enveloped[n] = mesh.phi[n] < 0;
  for (const Tet& tet : mesh.tets) {
    for (const auto& [a, b] : kTetEdges) {
      const std::int32_t i = tet[a], j = tet[b];
      if (mesh.phi[j] > -ratio * mesh.phi[i]) enveloped[i] = 0;
      if (mesh.phi[i] > -ratio * mesh.phi[j]) enveloped[j] = 0;
    }
  }
  return enveloped;
}

}  // namespace

Candidate selectCandidate(const LatticeMesh& mesh, const NodeStars& stars, const CandidateOptions& options) {
  KeptSet set(mesh, stars, envelopeInteriorNodes(mesh, options.minInsideFraction));
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
  std::vector<std::int32_t> compact(mesh.positions.size(), kNone);
  std::vector<std::uint8_t> partial(mesh.positions.size(), 0);
  TetMesh result;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const std::int32_t v : mesh.tets[t]) {
      if (keep[t]) {
        compact[v] = 0;
      } else {
        partial[v] = 1;
      }
    }
  }
  if (latticeNodes != nullptr) latticeNodes->clear();
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    if (compact[n] == kNone) continue;
    compact[n] = static_cast<std::int32_t>(result.nodes.size());
    result.nodes.push_back(mesh.positions[n]);
    result.kinds.push_back(partial[n] ? NodeKind::Boundary : NodeKind::Interior);
    if (latticeNodes != nullptr) latticeNodes->push_back(static_cast<std::int32_t>(n));
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!keep[t]) continue;
    Tet tet = mesh.tets[t];
    for (std::int32_t& v : tet) v = compact[v];
    result.tets.push_back(tet);
  }
  result.labels.assign(result.tets.size(), label);
  return result;
}

}  // namespace sinew
