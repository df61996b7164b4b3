#include "ActiveNodes.h"

#include "Parallel.h"
#include "sinew/Mesher/LatticeMesh.h"

#include <algorithm>
#include <array>
#include <bit>

namespace sinew {
namespace {

constexpr int kRings = 2;  // rings of nodes below the surface that take part
constexpr double kGreenShape =
    1.2;  // F of a tet above this (BCC 1.157): its nodes take part wherever they lie

/// The colour of nodes that do not move.
constexpr std::uint8_t kNoColor = 255;

/// Greedy, in the order of the nodes.
/// @return color[n] of the mesh nodes
std::vector<std::uint8_t> colorNodes(const TetMesh& mesh, const NodeStars& stars,
                                     const std::vector<std::int32_t>& nodes) {
  std::vector<std::uint8_t> color(mesh.nodes.size(), kNoColor);
  for (const std::int32_t n : nodes) {
    std::uint64_t used = 0;
    for (const std::int32_t t : stars.of(n)) {
      for (const std::int32_t v : mesh.tets[t]) {
        if (color[v] != kNoColor) used |= std::uint64_t{1} << color[v];
      }
    }
    color[n] = static_cast<std::uint8_t>(std::countr_one(used));
  }
  return color;
}

/// Nodes of one color side by side, and so their stars: a sweep reads memory from front to back.
void sortByColor(const std::vector<std::uint8_t>& color, ActiveNodes& active) {
  std::array<std::size_t, kNoColor> count{};
  for (const std::int32_t n : active.nodes) ++count[color[n]];
  for (std::size_t begin = 0; begin < active.size(); begin = active.colors.back().end)
    active.colors.push_back({begin, begin + count[active.colors.size()]});
  std::array<std::size_t, kNoColor> next{};
  for (std::size_t c = 0; c < active.colors.size(); ++c) next[c] = active.colors[c].begin;
  std::vector<std::int32_t> sorted(active.size());
  for (const std::int32_t n : active.nodes) sorted[next[color[n]]++] = n;
  active.nodes = std::move(sorted);
}

void buildStars(const TetMesh& mesh, const NodeStars& stars, ActiveNodes& active) {
  active.offsets.assign(active.size() + 1, 0);
  for (std::size_t n = 0; n < active.size(); ++n)
    active.offsets[n + 1] = active.offsets[n] + static_cast<std::int32_t>(stars.of(active.nodes[n]).size());
  active.faces.resize(active.offsets.back());
  forEach(active.size(), [&](std::size_t n) {
    std::int32_t next = active.offsets[n];
    for (const std::int32_t t : stars.of(active.nodes[n])) {
      const Tet& tet = mesh.tets[t];
      const auto f = std::ranges::find(tet, active.nodes[n]) - tet.begin();
      const auto& [a, b, c] = kTetFaces[f];
      active.faces[next++] = {tet[a], tet[c], tet[b]};
    }
  });
}

}  // namespace

void growRings(const TetMesh& mesh, int rings, std::vector<std::uint8_t>& flags) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<std::uint8_t> grown = flags;
    forEach(mesh.tets.size(), [&](std::size_t t) {
      const Tet& tet = mesh.tets[t];
      const int flagged = flags[tet[0]] + flags[tet[1]] + flags[tet[2]] + flags[tet[3]];
      if (flagged == 0 || flagged == 4) return;
      for (const std::int32_t v : tet) setFlag(grown[v]);
    });
    flags.swap(grown);
  }
}

std::vector<std::uint8_t> movableNodes(const TetMesh& mesh) {
  std::vector<std::uint8_t> movable(mesh.nodes.size());
  for (std::size_t n = 0; n < movable.size(); ++n) movable[n] = mesh.kinds[n] == NodeKind::Boundary;
  growRings(mesh, kRings, movable);
  forEach(mesh.tets.size(), [&](std::size_t t) {
    const Tet& tet = mesh.tets[t];
    if (std::ranges::all_of(tet, [&](std::int32_t v) { return isSet(movable[v]); })) return;
    if (shapeMeasure(tet, mesh.nodes) <= kGreenShape) return;
    for (const std::int32_t v : tet) setFlag(movable[v]);
  });
  return movable;
}

ActiveNodes activeNodes(const TetMesh& mesh, const std::vector<std::uint8_t>& movable) {
  const NodeStars stars = nodeStars(mesh.nodes.size(), mesh.tets);
  ActiveNodes active;
  active.nodes = collect<std::int32_t>(movable.size(), [&](std::size_t n, auto& nodes) {
    if (movable[n] != 0) nodes.push_back(static_cast<std::int32_t>(n));
  });
  sortByColor(colorNodes(mesh, stars, active.nodes), active);
  active.indexOf.assign(mesh.nodes.size(), -1);
  forEach(active.size(),
          [&](std::size_t n) { active.indexOf[active.nodes[n]] = static_cast<std::int32_t>(n); });
  buildStars(mesh, stars, active);
  return active;
}

}  // namespace sinew
