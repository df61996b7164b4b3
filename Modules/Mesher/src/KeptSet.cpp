#include "KeptSet.h"

#include <tbb/parallel_for.h>

#include <array>
#include <utility>

namespace sinew {
namespace {

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

Enveloped envelopeViolations(KeptSet& set, std::vector<std::int32_t> suspects, int most) {
  Enveloped result;
  while (true) {
    const std::vector<std::int32_t> nodes =
        chooseNodes(set, suspects, [&](auto violation) { return cheapestToEnvelope(set, violation); });
    result.violations = static_cast<std::int64_t>(nodes.size());
    if (nodes.empty() || result.passes == most) return result;
    for (const std::int32_t n : nodes) set.envelope(n);
    result.nodes.insert(result.nodes.end(), nodes.begin(), nodes.end());
    ++result.passes;
    suspects = neighbourhood(set, nodes);
  }
}

namespace {

std::vector<std::int32_t> shallowestAtViolations(const KeptSet& set,
                                                 const std::vector<std::int32_t>& suspects) {
  return chooseNodes(set, suspects, [&](auto violation) { return set.shallowestAt(violation); });
}

}  // namespace

std::vector<std::int32_t> releaseViolations(KeptSet& set, std::vector<std::int32_t> suspects) {
  return releaseNodes(set, shallowestAtViolations(set, suspects));
}

std::vector<std::int32_t> releaseNodes(KeptSet& set, std::vector<std::int32_t> nodes, std::size_t most) {
  std::vector<std::int32_t> released;
  while (!nodes.empty()) {
    for (const std::int32_t n : nodes) set.release(n);
    released.insert(released.end(), nodes.begin(), nodes.end());
    if (released.size() > most) {
      for (const std::int32_t n : released) set.envelope(n);
      return {};
    }
    nodes = shallowestAtViolations(set, neighbourhood(set, nodes));
  }
  sortUnique(released);
  return released;
}

std::vector<std::int32_t> envelopeNode(KeptSet& set, std::int32_t node, std::size_t most) {
  constexpr int kPasses = 4;
  set.envelope(node);
  Enveloped all = envelopeViolations(set, neighbourhood(set, {node}), kPasses);
  all.nodes.push_back(node);
  sortUnique(all.nodes);
  if (all.violations == 0 && all.nodes.size() <= most) return all.nodes;
  for (const std::int32_t n : all.nodes) set.release(n);
  return {};
}

}  // namespace sinew
