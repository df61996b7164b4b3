#include "TopologyDifferences.h"

#include "VoxelMask.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <queue>
#include <utility>

namespace sinew {
namespace {

using Node = Eigen::Vector3i;

constexpr int kNeighbours = 14;
constexpr unsigned kAllNeighbours = (1u << kNeighbours) - 1;

/// Neighbours of a node in Kuhn's subdivision: the corners 1..7 of the cube above it, then those of the cube
/// below.
constexpr std::array<std::array<int, 3>, kNeighbours> kOffsets = [] {
  std::array<std::array<int, 3>, kNeighbours> offsets{};
  for (int corner = 1; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis) {
      offsets[corner - 1][axis] = corner >> axis & 1;
      offsets[corner + 6][axis] = -(corner >> axis & 1);
    }
  return offsets;
}();

/// Which of a node's neighbours are neighbours of each other; the node's link is a sphere of these edges and
/// their triangles.
constexpr std::array<unsigned, kNeighbours> kLink = [] {
  std::array<unsigned, kNeighbours> link{};
  for (int a = 0; a < kNeighbours; ++a)
    for (int b = 0; b < kNeighbours; ++b) {
      int least = 0, most = 0;
      for (int axis = 0; axis < 3; ++axis) {
        least = std::min(least, kOffsets[b][axis] - kOffsets[a][axis]);
        most = std::max(most, kOffsets[b][axis] - kOffsets[a][axis]);
      }
      if (most - least == 1) link[a] |= 1u << b;
    }
  return link;
}();
static_assert(
    [] {
      int twiceEdges = 0;
      for (const unsigned neighbours : kLink) twiceEdges += std::popcount(neighbours);
      return twiceEdges == 2 * 36;
    }(),
    "a sphere of 14 nodes has 36 edges");

Node neighbour(const Node& node, int n) {
  return node + Node(kOffsets[n][0], kOffsets[n][1], kOffsets[n][2]);
}

/// Whether some neighbours of a node are one piece of its link.
bool connected(unsigned neighbours) {
  if (neighbours == 0) return false;
  unsigned reached = 0, next = neighbours & -neighbours;
  while (next != 0) {
    reached |= next;
    unsigned around = 0;
    for (; next != 0; next &= next - 1) around |= kLink[std::countr_zero(next)];
    next = around & neighbours & ~reached;
  }
  return reached == neighbours;
}

/// V - E + F of the part of a node's link that some neighbours span.
int euler(unsigned neighbours) {
  int nodes = 0, edges = 0, triangles = 0;
  for (unsigned rest = neighbours; rest != 0; rest &= rest - 1) {
    const unsigned after = kLink[std::countr_zero(rest)] & rest;  // later neighbours, counted once
    ++nodes;
    edges += std::popcount(after);
    for (unsigned second = after; second != 0; second &= second - 1)
      triangles += std::popcount(kLink[std::countr_zero(second)] & second & after);
  }
  return nodes - edges + triangles;
}

/// A node on which mesh and shape differ.
struct Differing {
  float depth;  ///< |phi|, mm
  Node node;
  bool operator<(const Differing& other) const {
    if (depth != other.depth) return depth < other.depth;
    return std::ranges::lexicographical_compare(node, other.node);
  }
};

/// What lies around a patch of nodes.
struct Sides {
  bool inside = false, outside = false;  ///< nodes of the set, and others
};

/// @param lost         the mesh lacks what it differs by; otherwise it has it too much
/// @param eulerChange  of the solid that the mesh fills, were it mended
TopologyChange changeOf(bool lost, const Sides& sides, int eulerChange) {
  using enum TopologyChange;
  if (!sides.inside) return lost ? PieceLost : PieceAdded;
  if (!sides.outside) return lost ? VoidOpened : VoidClosed;
  // A bridge or a hole is one handle more, of the solid or of what is around it.
  if (eulerChange <= 0) return lost ? BridgeLost : HoleClosed;
  return lost ? SheetPierced : GapClosed;
}

class Comparison {
 public:
  Comparison(const TetMesh& mesh, const LevelSetSurface& surface, const Eigen::Isometry3d& frame)
      : surface_(surface),
        frame_(frame),
        set_(voxelsInMesh(mesh, Eigen::Scaling(1 / surface.resolution()) * frame.inverse(),
                          {surface.nodesLower().array() - 1, surface.nodesUpper().array() + 1})) {}

  std::vector<TopologyDifference> differences() {
    becomeShape();
    std::vector<TopologyDifference> differences;
    for (const Differing& seed : differing())  // deepest first
      if (differs(seed.node)) differences.push_back(settle(seed));
    return differences;
  }

 private:
  bool inShape(const Node& node) const { return surface_.atNode(node) < 0; }
  bool differs(const Node& node) const { return set_.test(node) != inShape(node); }

  unsigned neighboursInSet(const Node& node) const {
    unsigned neighbours = 0;
    for (int n = 0; n < kNeighbours; ++n) neighbours |= unsigned{set_.test(neighbour(node, n))} << n;
    return neighbours;
  }

  bool simple(const Node& node) const {
    const unsigned inside = neighboursInSet(node);
    return connected(inside) && connected(~inside & kAllNeighbours);
  }

  /// All such nodes, the deepest first.
  std::vector<Differing> differing() const {
    constexpr int kCells = LevelSetSurface::kCells;
    const std::vector<Node> bricks = surface_.bandBricks();
    std::vector<std::vector<Differing>> found(bricks.size());
    tbb::parallel_for(std::size_t{0}, bricks.size(), [&](std::size_t brick) {
      for (int x = 0; x < kCells; ++x)
        for (int y = 0; y < kCells; ++y)
          for (int z = 0; z < kCells; ++z) {
            const Node node = bricks[brick] + Node(x, y, z);
            if (differs(node)) found[brick].push_back({std::abs(surface_.atNode(node)), node});
          }
    });
    std::vector<Differing> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::ranges::sort(all, [](const auto& a, const auto& b) { return b < a; });
    return all;
  }

  /// Makes the set the shape, as far as that keeps its topology.
  void becomeShape() {
    std::priority_queue<Differing> queue(std::less<Differing>(), differing());
    while (!queue.empty()) {
      const Node node = queue.top().node;
      queue.pop();
      if (!differs(node) || !simple(node)) continue;
      set_.flip(node);
      for (int n = 0; n < kNeighbours; ++n) {
        const Node next = neighbour(node, n);
        if (differs(next)) queue.push({std::abs(surface_.atNode(next)), next});
      }
    }
  }

  /// Makes the set the shape around a node, and says what that changed.
  /// @param seed  deepest node of those that are connected with it
  TopologyDifference settle(const Differing& seed) {
    const bool lost = inShape(seed.node);
    std::vector<Node> patch{seed.node};
    int eulerChange = flip(seed.node);
    for (std::size_t k = 0; k < patch.size(); ++k)
      for (int n = 0; n < kNeighbours; ++n) {
        const Node next = neighbour(patch[k], n);
        if (!differs(next) || inShape(next) != lost) continue;
        eulerChange += flip(next);
        patch.push_back(next);
      }
    const double sample = surface_.resolution();
    TopologyDifference difference;
    difference.change = changeOf(lost, sides(patch), eulerChange);
    difference.place = frame_ * (sample * seed.node.cast<double>());
    difference.width = 2 * seed.depth;
    difference.euler = 2 * eulerChange;  // of the boundary of a solid
    difference.volume = static_cast<double>(patch.size()) * sample * sample * sample;
    return difference;
  }

  Sides sides(std::vector<Node> patch) const {
    const auto before = [](const Node& a, const Node& b) {
      return std::ranges::lexicographical_compare(a, b);
    };
    std::ranges::sort(patch, before);
    Sides sides;
    for (const Node& node : patch)
      for (int n = 0; n < kNeighbours; ++n) {
        const Node next = neighbour(node, n);
        if (!std::ranges::binary_search(patch, next, before))
          (set_.test(next) ? sides.inside : sides.outside) = true;
      }
    return sides;
  }

  /// @return the change of the set's Euler characteristic, as a solid
  int flip(const Node& node) {
    const int change = 1 - euler(neighboursInSet(node));
    const bool removed = set_.test(node);
    set_.flip(node);
    return removed ? -change : change;
  }

  const LevelSetSurface& surface_;
  const Eigen::Isometry3d& frame_;
  VoxelMask set_;
};

}  // namespace

std::vector<TopologyDifference> topologyDifferences(const TetMesh& mesh, const LevelSetSurface& surface,
                                                    const Eigen::Isometry3d& frame) {
  return Comparison(mesh, surface, frame).differences();
}

const char* toString(TopologyChange change) {
  constexpr std::array kNames{"piece lost",  "bridge lost", "sheet pierced", "void opened",
                              "void closed", "hole closed", "gap closed",    "piece added"};
  return kNames[static_cast<std::size_t>(change)];
}

}  // namespace sinew
