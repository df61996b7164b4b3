#include "LoosePieces.h"

#include <algorithm>

namespace sinew {
namespace {

/// All nodes that tets connect with the `front`.
void flood(const ElasticBody& body, std::vector<std::size_t> front, std::vector<bool>& reached) {
  for (const std::size_t n : front) reached[n] = true;
  while (!front.empty()) {
    const std::size_t n = front.back();
    front.pop_back();
    for (std::int32_t k = body.firstCorner[n]; k < body.firstCorner[n + 1]; ++k)
      for (const std::int32_t other :
           body.tets[static_cast<std::size_t>(body.corners[static_cast<std::size_t>(k)] / 4)]) {
        const auto node = static_cast<std::size_t>(other);
        if (reached[node]) continue;
        reached[node] = true;
        front.push_back(node);
      }
  }
}

}  // namespace

LoosePieces findLoosePieces(const ElasticBody& body, const NodeConstraints& constraints) {
  std::vector<std::size_t> held;
  for (std::size_t n = 0; n < body.nodeCount(); ++n)
    if (constraints.freedom[n] == NodeFreedom::Held) held.push_back(n);
  std::vector<bool> reached(body.nodeCount(), false);
  flood(body, held, reached);
  LoosePieces loose;
  for (std::size_t n = 0; n < body.nodeCount(); ++n)
    if (!reached[n]) loose.nodes.push_back(static_cast<std::int32_t>(n));
  for (const Tet& tet : body.tets) loose.tets += reached[static_cast<std::size_t>(tet[0])] ? 0 : 1;
  for (std::size_t t = 0; t < body.tets.size(); ++t) {
    const auto node = static_cast<std::size_t>(body.tets[t][0]);
    if (reached[node]) continue;
    if (loose.pieces++ == 0) loose.firstTet = static_cast<std::int64_t>(t);
    flood(body, {node}, reached);
  }
  return loose;
}

bool areConnected(const ElasticBody& body, const std::vector<std::int32_t>& these,
                  const std::vector<std::int32_t>& those) {
  std::vector<bool> reached(body.nodeCount(), false);
  flood(body, {these.begin(), these.end()}, reached);
  return std::ranges::any_of(those, [&](std::int32_t n) { return reached[static_cast<std::size_t>(n)]; });
}

}  // namespace sinew
