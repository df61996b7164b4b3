#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sinew {

/// The edges of a mesh, each once, ascending by their nodes.
/// Cost: O(tets log valence) to build, O(log valence) to find one.
class TetEdges {
 public:
  explicit TetEdges(const TetMesh& mesh) : first_(mesh.nodes.size() + 1, 0) {
    const std::vector<std::int64_t> end = sortByLowerNode(mesh);
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      const auto begin = others_.begin() + (node == 0 ? 0 : end[node - 1]);
      const auto target = others_.begin() + first_[node];
      std::sort(begin, others_.begin() + end[node]);
      const auto stop = std::unique(begin, others_.begin() + end[node]);
      if (target != begin) std::move(begin, stop, target);  // lists shrink, so they move to the front
      first_[node + 1] = first_[node] + (stop - begin);
    }
    others_.resize(static_cast<std::size_t>(first_.back()));
  }

  std::size_t size() const { return others_.size(); }

  /// The number of the edge between two nodes of a tet.
  std::size_t find(std::int32_t a, std::int32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    const auto begin = others_.begin() + first_[low], end = others_.begin() + first_[low + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, high) - others_.begin());
  }

  /// Calls visit(low, high) for every edge in order.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (std::size_t node = 0; node + 1 < first_.size(); ++node)
      for (std::int64_t e = first_[node]; e < first_[node + 1]; ++e)
        visit(static_cast<std::int32_t>(node), others_[static_cast<std::size_t>(e)]);
  }

 private:
  /// Fills others_ with the higher node of every edge of every tet, by the lower one.
  /// @return where each lower node's ends
  std::vector<std::int64_t> sortByLowerNode(const TetMesh& mesh) {
    std::vector<std::int64_t> end(mesh.nodes.size() + 1, 0);
    const auto forEachEdge = [&](const auto& visit) {
      for (const Tet& tet : mesh.tets)
        for (const auto& [i, j] : kTetEdges) {
          const auto [low, high] = std::minmax(tet[i], tet[j]);
          visit(low, high);
        }
    };
    forEachEdge([&](std::int32_t low, std::int32_t) { ++end[low + 1]; });
    for (std::size_t node = 1; node < end.size(); ++node) end[node] += end[node - 1];
    others_.resize(static_cast<std::size_t>(end.back()));
    forEachEdge([&](std::int32_t low, std::int32_t high) { others_[end[low]++] = high; });
    return end;
  }

  std::vector<std::int64_t> first_;   ///< of each lower node, in others_
  std::vector<std::int32_t> others_;  ///< higher nodes
};

}  // namespace sinew
