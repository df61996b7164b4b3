#include "sinew/Mesher/Candidate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace sinew {
namespace {

constexpr std::int32_t kNone = -1;

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

/// The kept set while it is repaired. A node is a boundary node when its star is kept in part.
class KeptSet {
 public:
  KeptSet(const LatticeMesh& mesh, const NodeStars& stars, std::vector<std::uint8_t> enveloped)
      : mesh_(mesh),
        stars_(stars),
        enveloped_(std::move(enveloped)),
        keep_(mesh.tets.size(), 0),
        keptTets_(mesh.phi.size(), 0) {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const Tet& tet = mesh_.tets[t];
      if (hasEnveloped(tet)) keepTet(t);
    }
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

  /// The enveloped nodes of the tets that hold all the given nodes.
  std::vector<std::int32_t> envelopedAt(std::span<const std::int32_t> nodes) const {
    std::vector<std::int32_t> found;
    for (const std::int32_t t : stars_.of(nodes[0])) {
      const Tet& tet = mesh_.tets[t];
      const bool holdsAll = std::all_of(nodes.begin(), nodes.end(), [&](std::int32_t n) {
        return std::find(tet.begin(), tet.end(), n) != tet.end();
      });
      if (!holdsAll) continue;
      for (const std::int32_t v : tet) {
        if (isEnveloped(v)) found.push_back(v);
      }
    }
    return found;
  }

  /// The shallowest of envelopedAt; kNone if there is none.
  std::int32_t shallowestAt(std::span<const std::int32_t> nodes) const {
    std::pair<double, std::int32_t> best{-std::numeric_limits<double>::infinity(), kNone};
    for (const std::int32_t v : envelopedAt(nodes)) best = std::max(best, std::pair(mesh_.phi[v], v));
    return best.second;
  }

  void moveInto(Candidate& candidate) {
    candidate.enveloped = std::move(enveloped_);
    candidate.keep = std::move(keep_);
  }

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

/// A triangle (n, a, b) of the star of n, seen from one of its tets.
struct StarFace {
  std::int32_t a, b;  // a < b
  bool kept;
  bool operator<(const StarFace& o) const { return std::pair(a, b) < std::pair(o.a, o.b); }
};

/// Examines the star of one boundary node for violations of T1 and T3 and for interior faces with three
/// boundary nodes.
class StarCheck {
 public:
  explicit StarCheck(const KeptSet& set) : set_(set) {}

  /// Calls report(span of nodes) for each violation at n: the node, an edge's two, or a face's three.
  template <class Report>
  void operator()(std::int32_t n, const Report& report) {
    gatherFaces(n);
    rim_.clear();
    candidates_.clear();
    for (std::size_t f = 0; f < faces_.size(); f += 2) {
      const StarFace& face = faces_[f];
      const bool first = face.kept, second = faces_[f + 1].kept;
      if (first != second) {
        rim_.emplace_back(face.a, face.b);
      } else if (first) {
        if (set_.isBoundary(face.a) && set_.isBoundary(face.b)) reportNodes<3>({n, face.a, face.b}, report);
        if (set_.isBoundary(face.a)) candidates_.push_back(face.a);
        if (set_.isBoundary(face.b)) candidates_.push_back(face.b);
      }
    }
    if (!rimIsOneCycle()) reportNodes<1>({n}, report);
    reportInteriorEdges(n, report);
  }

 private:
  void gatherFaces(std::int32_t n) {
    faces_.clear();
    for (const std::int32_t t : set_.stars().of(n)) {
      const Tet& tet = set_.mesh().tets[t];
      std::array<std::int32_t, 3> others;
      int count = 0;
      for (const std::int32_t v : tet) {
        if (v != n) others[count++] = v;
      }
      const bool kept = set_.isKept(t);
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = others[k], b = others[(k + 1) % 3];
        faces_.push_back({std::min(a, b), std::max(a, b), kept});
      }
    }
    std::sort(faces_.begin(), faces_.end());
  }

  /// T1: the boundary triangles around the node form one closed fan, every edge in two of them.
  bool rimIsOneCycle() {
    if (rim_.empty()) return false;
    std::size_t walked = 1;
    const std::int32_t start = rim_[0].first;
    std::int32_t at = rim_[0].second;
    std::size_t last = 0;
    while (at != start) {
      std::size_t next = rim_.size();
      for (std::size_t e = 0; e < rim_.size(); ++e) {
        if (e == last || (rim_[e].first != at && rim_[e].second != at)) continue;
        if (next != rim_.size()) return false;  // a third triangle at this edge
        next = e;
      }
      if (next == rim_.size()) return false;
      at = rim_[next].first == at ? rim_[next].second : rim_[next].first;
      last = next;
      ++walked;
    }
    return walked == rim_.size();
  }

  /// T3: edges to boundary nodes that lie on no boundary triangle.
  template <class Report>
  void reportInteriorEdges(std::int32_t n, const Report& report) {
    std::sort(candidates_.begin(), candidates_.end());
    candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
    for (const std::int32_t other : candidates_) {
      const bool onRim = std::any_of(rim_.begin(), rim_.end(),
                                     [&](const auto& e) { return e.first == other || e.second == other; });
      if (!onRim) reportNodes<2>({n, other}, report);
    }
  }

  template <std::size_t N, class Report>
  static void reportNodes(const std::array<std::int32_t, N>& nodes, const Report& report) {
    report(std::span<const std::int32_t>(nodes));
  }

  const KeptSet& set_;
  std::vector<StarFace> faces_;
  std::vector<std::pair<std::int32_t, std::int32_t>> rim_;
  std::vector<std::int32_t> candidates_;
};

void sortUnique(std::vector<std::int32_t>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

/// choose(violation) for every violation at the suspects, ascending, without kNone.
template <class Choose>
std::vector<std::int32_t> chooseNodes(const KeptSet& set, const std::vector<std::int32_t>& suspects,
                                      const Choose& choose) {
  constexpr std::size_t grain = 1024;
  std::vector<std::vector<std::int32_t>> found((suspects.size() + grain - 1) / grain);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t block) {
    StarCheck check(set);
    const auto report = [&](std::span<const std::int32_t> violation) {
      const std::int32_t node = choose(violation);
      if (node != kNone) found[block].push_back(node);
    };
    const std::size_t end = std::min(suspects.size(), (block + 1) * grain);
    for (std::size_t s = block * grain; s < end; ++s) {
      if (set.isBoundary(suspects[s])) check(suspects[s], report);
    }
  });
  std::vector<std::int32_t> nodes;
  for (const auto& block : found) nodes.insert(nodes.end(), block.begin(), block.end());
  sortUnique(nodes);
  return nodes;
}

/// Of the nodes of a violation the one whose envelope adds least outside material.
std::int32_t cheapestToEnvelope(const KeptSet& set, std::span<const std::int32_t> violation) {
  std::pair<double, std::int32_t> best{std::numeric_limits<double>::infinity(), kNone};
  for (const std::int32_t v : violation) best = std::min(best, std::pair(set.outsideCost(v), v));
  return best.second;
}

/// Nodes within two stars of the given ones: those whose checks may have changed.
std::vector<std::int32_t> neighbourhood(const KeptSet& set, std::vector<std::int32_t> nodes) {
  for (int ring = 0; ring < 2; ++ring) {
    const std::size_t before = nodes.size();
    for (std::size_t n = 0; n < before; ++n) {
      for (const std::int32_t t : set.stars().of(nodes[n])) {
        const Tet& tet = set.mesh().tets[t];
        nodes.insert(nodes.end(), tet.begin(), tet.end());
      }
    }
    sortUnique(nodes);
  }
  return nodes;
}

}  // namespace

Candidate selectCandidate(const LatticeMesh& mesh, const NodeStars& stars, const CandidateOptions& options) {
  KeptSet set(mesh, stars, envelopeInteriorNodes(mesh, options.minInsideFraction));
  Candidate candidate;
  std::vector<std::int32_t> suspects(mesh.phi.size());
  std::iota(suspects.begin(), suspects.end(), 0);
  while (true) {
    const std::vector<std::int32_t> nodes =
        chooseNodes(set, suspects, [&](auto violation) { return cheapestToEnvelope(set, violation); });
    candidate.violations = static_cast<std::int64_t>(nodes.size());
    if (nodes.empty() || candidate.passes == options.maxPasses) break;
    for (const std::int32_t n : nodes) set.envelope(n);
    candidate.added += static_cast<std::int64_t>(nodes.size());
    ++candidate.passes;
    suspects = neighbourhood(set, nodes);
  }
  set.moveInto(candidate);
  return candidate;
}

std::vector<std::int32_t> retreat(const LatticeMesh& mesh, const NodeStars& stars, Candidate& candidate,
                                  const std::vector<Trouble>& troubles, bool thoroughly) {
  KeptSet set(mesh, stars, std::move(candidate.enveloped));
  std::vector<std::int32_t> released, nodes;
  for (const Trouble& trouble : troubles) {
    const std::int32_t node = set.shallowestAt(trouble);
    if (node == kNone) continue;
    nodes.push_back(node);
    if (!thoroughly) continue;
    const std::vector<std::int32_t> all = set.envelopedAt(trouble);
    nodes.insert(nodes.end(), all.begin(), all.end());
  }
  sortUnique(nodes);
  while (!nodes.empty()) {
    for (const std::int32_t n : nodes) set.release(n);
    released.insert(released.end(), nodes.begin(), nodes.end());
    nodes = chooseNodes(set, neighbourhood(set, nodes),
                        [&](auto violation) { return set.shallowestAt(violation); });
  }
  set.moveInto(candidate);
  sortUnique(released);
  return released;
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
