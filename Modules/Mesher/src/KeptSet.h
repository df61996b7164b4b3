#pragma once

#include "Parallel.h"
#include "sinew/Mesher/LatticeMesh.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace sinew {

/// No node.
inline constexpr std::int32_t kNone = -1;

inline void sortUnique(std::vector<std::int32_t>& nodes) {
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

/// The kept set while it is repaired. A node is a boundary node when its star is kept in part.
class KeptSet {
 public:
  KeptSet(const LatticeMesh& mesh, const NodeStars& stars, std::vector<std::uint8_t> enveloped)
      : mesh_(mesh),
        stars_(stars),
        enveloped_(std::move(enveloped)),
        keep_(mesh.tets.size(), 0),
        keptTets_(mesh.phi.size(), 0) {
    forEach(keep_.size(), [&](std::size_t t) { keep_[t] = hasEnveloped(mesh_.tets[t]); });
    forEach(keptTets_.size(), [&](std::size_t n) {
      for (const std::int32_t t : stars_.of(static_cast<std::int32_t>(n))) keptTets_[n] += keep_[t];
    });
  }

  bool isBoundary(std::int32_t n) const {
    return keptTets_[n] > 0 && keptTets_[n] < static_cast<std::int32_t>(stars_.of(n).size());
  }
  bool isEnveloped(std::int32_t n) const { return enveloped_[n] != 0; }
  bool isKept(std::int32_t t) const { return keep_[t] != 0; }
  const LatticeMesh& mesh() const { return mesh_; }
  const NodeStars& stars() const { return stars_; }

  /// Keeps the whole star of a node.
  void envelope(std::int32_t n) {
    enveloped_[n] = 1;
    for (const std::int32_t t : stars_.of(n)) {
      if (!isKept(t)) keepTet(t);
    }
  }

  /// Takes back the envelope of a node: its tets stay only where another enveloped node needs them.
  void release(std::int32_t n) {
    enveloped_[n] = 0;
    for (const std::int32_t t : stars_.of(n)) {
      if (isKept(t) && !hasEnveloped(mesh_.tets[t])) dropTet(t);
    }
  }

  /// How far outside the tets lie that enveloping a node would add: the largest phi at their centroids.
  double outsideCost(std::int32_t n) const {
    double cost = -std::numeric_limits<double>::infinity();
    for (const std::int32_t t : stars_.of(n)) {
      if (isKept(t)) continue;
      const Tet& tet = mesh_.tets[t];
      cost = std::max(cost,
                      0.25 * (mesh_.phi[tet[0]] + mesh_.phi[tet[1]] + mesh_.phi[tet[2]] + mesh_.phi[tet[3]]));
    }
    return cost;
  }

  /// The shallowest enveloped node of the tets that hold all the given nodes; kNone if there is none.
  std::int32_t shallowestAt(std::span<const std::int32_t> nodes) const {
    std::pair<double, std::int32_t> best{-std::numeric_limits<double>::infinity(), kNone};
    for (const std::int32_t t : stars_.of(nodes[0])) {
      const Tet& tet = mesh_.tets[t];
      const bool holdsAll = std::all_of(nodes.begin(), nodes.end(), [&](std::int32_t n) {
        return std::find(tet.begin(), tet.end(), n) != tet.end();
      });
      if (!holdsAll) continue;
      for (const std::int32_t v : tet) {
        if (isEnveloped(v)) best = std::max(best, std::pair(mesh_.phi[v], v));
      }
    }
    return best.second;
  }

  const std::vector<std::uint8_t>& enveloped() const { return enveloped_; }
  const std::vector<std::uint8_t>& keep() const { return keep_; }

 private:
  void keepTet(std::size_t t) {
    keep_[t] = 1;
    for (const std::int32_t v : mesh_.tets[t]) ++keptTets_[v];
  }
  void dropTet(std::size_t t) {
    keep_[t] = 0;
    for (const std::int32_t v : mesh_.tets[t]) --keptTets_[v];
  }
  bool hasEnveloped(const Tet& tet) const {
    return std::any_of(tet.begin(), tet.end(), [&](std::int32_t v) { return enveloped_[v] != 0; });
  }

  const LatticeMesh& mesh_;
  const NodeStars& stars_;
  std::vector<std::uint8_t> enveloped_;
  std::vector<std::uint8_t> keep_;
  std::vector<std::int32_t> keptTets_;
};

/// Envelops nodes at violations of T1, T3 and the rule about interior faces until there are none among the
/// suspects and what changes around them.
/// @param most  passes
struct Enveloped {
  std::vector<std::int32_t> nodes;  ///< in the order in which they were enveloped
  int passes = 0;
  std::int64_t violations = 0;  ///< what is left after the last pass
};
Enveloped envelopeViolations(KeptSet& set, std::vector<std::int32_t> suspects, int most);

/// Releases enveloped nodes, and more of them until the conditions hold again: a set that only shrinks, so
/// that a compressed mesh which loses the same tets has none inverted.
/// @param most  where more nodes would have to go (a thin sheet can unravel as a whole), none is released
/// @return the nodes released, ascending
std::vector<std::int32_t> releaseNodes(KeptSet& set, std::vector<std::int32_t> nodes,
                                       std::size_t most = std::numeric_limits<std::size_t>::max());

/// Releases nodes at the violations among the suspects until the conditions hold.
/// @return the nodes released, ascending
std::vector<std::int32_t> releaseViolations(KeptSet& set, std::vector<std::int32_t> suspects);

/// Envelops a node, and more of them until the conditions hold again; the other way round than releaseNodes.
/// @param most  where more nodes would have to come in, the set stays as it is
/// @return the nodes enveloped, ascending
std::vector<std::int32_t> envelopeNode(KeptSet& set, std::int32_t node, std::size_t most);

}  // namespace sinew
