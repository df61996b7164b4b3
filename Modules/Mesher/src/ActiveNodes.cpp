#include "ActiveNodes.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace sinew {
namespace {

constexpr int kRings = 2;  // rings of nodes below the surface that take part
constexpr double kGreenShape =
    1.2;  // F of a tet above this (BCC 1.157): its nodes take part wherever they lie

void buildStars(const TetMesh& mesh, ActiveNodes& active) {
  active.offsets.assign(active.size() + 1, 0);
  for (const Tet& tet : mesh.tets) {
    for (const std::int32_t v : tet) {
      if (active.indexOf[v] >= 0) ++active.offsets[active.indexOf[v] + 1];
    }
  }
  for (std::size_t n = 0; n < active.size(); ++n) active.offsets[n + 1] += active.offsets[n];
  active.faces.resize(active.offsets.back());
  std::vector<std::int32_t> next(active.offsets.begin(), active.offsets.end() - 1);
  for (const Tet& tet : mesh.tets) {
    for (int f = 0; f < 4; ++f) {
      const std::int32_t index = active.indexOf[tet[f]];
      if (index < 0) continue;
      const auto& [a, b, c] = kTetFaces[f];
      active.faces[next[index]++] = {tet[a], tet[c], tet[b]};
    }
  }
}

/// Greedy, in the order of the nodes.
std::vector<std::uint8_t> colorNodes(const ActiveNodes& active) {
  constexpr std::uint8_t kNone = 255;
  std::vector<std::uint8_t> color(active.size(), kNone);
  for (std::size_t n = 0; n < active.size(); ++n) {
    std::uint64_t used = 0;
    for (const StarFaceNodes& face : active.star(static_cast<std::int32_t>(n))) {
      for (const std::int32_t v : face) {
        const std::int32_t other = active.indexOf[v];
        if (other >= 0 && color[other] != kNone) used |= std::uint64_t{1} << color[other];
      }
    }
    color[n] = static_cast<std::uint8_t>(std::countr_one(used));
  }
  return color;
}

/// Nodes of one color side by side, and so their stars: a sweep reads memory from front to back.
void sortByColor(ActiveNodes& active, const std::vector<std::uint8_t>& color) {
  std::vector<std::int32_t> order(active.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::int32_t n) { return color[n]; });
  ActiveNodes sorted;
  sorted.indexOf = std::move(active.indexOf);
  sorted.offsets = {0};
  sorted.faces.reserve(active.faces.size());
  for (const std::int32_t n : order) {
    if (sorted.colors.size() == color[n]) sorted.colors.push_back({sorted.nodes.size(), sorted.nodes.size()});
    sorted.indexOf[active.nodes[n]] = static_cast<std::int32_t>(sorted.nodes.size());
    sorted.nodes.push_back(active.nodes[n]);
    sorted.faces.insert(sorted.faces.end(), active.star(n).begin(), active.star(n).end());
    sorted.offsets.push_back(static_cast<std::int32_t>(sorted.faces.size()));
    sorted.colors.back().end = sorted.nodes.size();
  }
  active = std::move(sorted);
}

}  // namespace

void growRings(const TetMesh& mesh, int rings, std::vector<std::uint8_t>& flags) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<std::uint8_t> grown = flags;
    for (const Tet& tet : mesh.tets) {
      if ((flags[tet[0]] | flags[tet[1]] | flags[tet[2]] | flags[tet[3]]) == 0) continue;
      for (const std::int32_t v : tet) grown[v] = 1;
    }
    flags.swap(grown);
  }
}

std::vector<std::uint8_t> movableNodes(const TetMesh& mesh) {
  std::vector<std::uint8_t> movable(mesh.nodes.size());
  for (std::size_t n = 0; n < movable.size(); ++n) movable[n] = mesh.kinds[n] == NodeKind::Boundary;
  growRings(mesh, kRings, movable);
  const auto& x = mesh.nodes;
  for (const Tet& tet : mesh.tets) {
    if (shapeMeasure(x[tet[3]], x[tet[0]], x[tet[1]], x[tet[2]]) <= kGreenShape) continue;
    for (const std::int32_t v : tet) movable[v] = 1;
  }
  return movable;
}

ActiveNodes activeNodes(const TetMesh& mesh, const std::vector<std::uint8_t>& movable) {
  ActiveNodes active;
  active.indexOf.assign(mesh.nodes.size(), -1);
  for (std::size_t n = 0; n < movable.size(); ++n) {
    if (movable[n] == 0) continue;
    active.indexOf[n] = static_cast<std::int32_t>(active.nodes.size());
    active.nodes.push_back(static_cast<std::int32_t>(n));
  }
  buildStars(mesh, active);
  sortByColor(active, colorNodes(active));
  return active;
}

}  // namespace sinew
