#include "ClosedSurfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace sinew {
namespace {

[[noreturn]] void refuseSurface(const std::string& what) {
  throw std::invalid_argument("levelSetFromTriangles: " + what);
}

void checkTriangles(const TriangleSurface& surface) {
  if (surface.triangles.empty()) refuseSurface("there are no triangles");
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const std::string name = "triangle " + std::to_string(t);
    for (const std::int32_t node : {a, b, c}) {
      if (node < 0 || static_cast<std::size_t>(node) >= surface.nodes.size())
        refuseSurface(name + " names node " + std::to_string(node) + ", which is not there");
      if (!surface.nodes[node].allFinite())
        refuseSurface("node " + std::to_string(node) + " has no finite coordinates");
    }
    if (a == b || b == c || c == a) refuseSurface(name + " names a node twice");
  }
}

/// Side k of a triangle, from its node k to its next one.
struct Side {
  std::int32_t low, high;  ///< nodes
  std::int32_t triangle;
  bool upwards;  ///< runs from low to high
};

/// Sorted by edge.
std::vector<Side> sidesOf(const TriangleSurface& surface) {
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t from = surface.triangles[t][k], to = surface.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(t), from < to});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.triangle); });
  return sides;
}

/// How many edges are wrong, by kind.
struct EdgeFaults {
  std::int64_t open = 0, crowded = 0, against = 0;

  std::string text() const {
    std::string all;
    for (const auto& [count, what] : {std::pair(open, "with one triangle (the surface is open)"),
                                      {crowded, "with more than two triangles"},
                                      {against, "between triangles turned against each other"}})
      if (count > 0)
        all += (all.empty() ? "" : ", ") + std::to_string(count) + (count == 1 ? " edge " : " edges ") + what;
    return all;
  }
};

/// Calls `pair(s, t)` with the triangles of every edge. @throws when one has not exactly two, turned alike
template <class Pair>
void forEachEdge(const std::vector<Side>& sides, Pair&& pair) {
  EdgeFaults faults;
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(
        first, sides.end(), [&](const Side& s) { return s.low != first->low || s.high != first->high; });
    if (last - first == 1)
      ++faults.open;
    else if (last - first > 2)
      ++faults.crowded;
    else if (first->upwards == std::next(first)->upwards)
      ++faults.against;
    else
      pair(first->triangle, std::next(first)->triangle);
    first = last;
  }
  if (const std::string text = faults.text(); !text.empty()) refuseSurface("no closed manifold: " + text);
}

/// Six times the volume between a triangle and a point is their determinant.
double signedVolume(const TriangleSurface& surface, std::int32_t triangle, const Eigen::Vector3d& apex) {
  const auto& [a, b, c] = surface.triangles[triangle];
  const Eigen::Vector3d A = surface.nodes[a] - apex, B = surface.nodes[b] - apex, C = surface.nodes[c] - apex;
  return A.dot(B.cross(C)) / 6;
}

}  // namespace

std::vector<ClosedSurface> closedSurfaces(const TriangleSurface& surface) {
  checkTriangles(surface);
  std::vector<std::int32_t> parent(surface.triangles.size());  // a forest; roots are the lowest numbers
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  forEachEdge(sidesOf(surface), [&](std::int32_t s, std::int32_t t) {
    const std::int32_t a = root(s), b = root(t);
    parent[std::max(a, b)] = std::min(a, b);
  });

  std::map<std::int32_t, ClosedSurface> byRoot;
  const Eigen::Vector3d apex = surface.nodes[surface.triangles[0][0]];  // near: less is lost by rounding
  for (std::int32_t t = 0; t < std::ssize(surface.triangles); ++t) {
    ClosedSurface& part = byRoot[root(t)];
    part.triangles.push_back(t);
    part.volume += signedVolume(surface, t, apex);
  }
  std::vector<ClosedSurface> parts;
  for (auto& [first, part] : byRoot) parts.push_back(std::move(part));
  return parts;
}

}  // namespace sinew
