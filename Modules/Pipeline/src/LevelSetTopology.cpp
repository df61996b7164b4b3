#include "LevelSetSurface.h"

#include <numeric>

namespace sinew {
namespace {

/// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2). In Kuhn's subdivision the simplices whose lowest
/// corner is the cell's corner 0 are the chains 0 < a < b < c of nested non-empty sets of axes.
constexpr bool nested(int a, int b) { return (a & b) == a && a != b; }

/// Alternating number of those simplices that have all their corners in `inside`, a set of corners that holds
/// 0.
constexpr int eulerOfCorners(int inside) {
  const auto has = [&](int corner) { return (inside >> corner & 1) != 0; };
  int euler = has(0);
  for (int a = 1; a < 8 && has(0); ++a) {
    if (!has(a)) continue;
    --euler;
    for (int b = 1; b < 8; ++b) {
      if (!has(b) || !nested(a, b)) continue;
      ++euler;
      for (int c = 1; c < 8; ++c) euler -= has(c) && nested(b, c);
    }
  }
  return euler;
}
static_assert(eulerOfCorners(0xff) == 0, "1 node - 7 edges + 12 triangles - 6 tets");

constexpr std::array<std::int8_t, 256> kEulerOfCorners = [] {
  std::array<std::int8_t, 256> table{};
  for (int inside = 0; inside < 256; ++inside)
    table[inside] = static_cast<std::int8_t>(eulerOfCorners(inside));
  return table;
}();

/// Sets that can be united; the smallest member stands for its set.
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

/// Numbers the nodes: 8^3 for a brick with values of its own, one for a constant brick.
class LevelSetTopologyCounter {
 public:
  explicit LevelSetTopologyCounter(const LevelSetSurface& surface)
      : surface_(surface), first_(surface.table_.size()) {
    std::uint32_t nodes = 0;
    for (std::size_t place = 0; place < first_.size(); ++place) {
      first_[place] = nodes;
      nodes += constant(place) ? 1 : kBrickNodes;
    }
    sets_ = UnionFind(nodes);
    inside_.resize(nodes);
  }

  LevelSetTopology count() {
    const Eigen::Vector3i& bricks = surface_.count_;
    for (int x = 0; x < bricks.x(); ++x)
      for (int y = 0; y < bricks.y(); ++y)
        for (int z = 0; z < bricks.z(); ++z) countBrick({x, y, z});
    LevelSetTopology topology;
    for (std::uint32_t node = 0; node < inside_.size(); ++node)
      topology.components += inside_[node] && sets_.find(node) == node;
    topology.eulerCharacteristic = 2 * solidEuler_;  // of a solid's boundary
    return topology;
  }

 private:
  static constexpr int kCells = LevelSetSurface::kCells;
  static constexpr std::uint32_t kBrickNodes = kCells * kCells * kCells;

  bool constant(std::size_t place) const { return surface_.table_[place] <= LevelSetSurface::kOutside; }

  /// Number of a node of a brick; a node may lie one past the brick's last.
  std::uint32_t number(Eigen::Vector3i place, Eigen::Vector3i node) const {
    place += node / kCells;
    node -= kCells * (node / kCells);
    const std::size_t entry = surface_.entry(place);
    return first_[entry] + (constant(entry) ? 0 : (node.x() * kCells + node.y()) * kCells + node.z());
  }

  void countBrick(const Eigen::Vector3i& place) {
    const std::size_t entry = surface_.entry(place);
    if (surface_.table_[entry] == LevelSetSurface::kOutside) return;
    if (surface_.table_[entry] == LevelSetSurface::kInside) {
      inside_[first_[entry]] = true;
      // Its cells are whole, but its last nodes join it to the next bricks.
      for (int corner = 1; corner < 8; ++corner)
        sets_.unite(first_[entry], number(place, kCells * offset(corner)));
      return;
    }
    const float* values = surface_.brick(place);
    for (int x = 0; x < kCells; ++x)
      for (int y = 0; y < kCells; ++y)
        for (int z = 0; z < kCells; ++z) countCell(place, {x, y, z}, values);
  }

  void countCell(const Eigen::Vector3i& place, const Eigen::Vector3i& node, const float* values) {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3i at = node + offset(corner);
      const float phi =
          values[at.x() * LevelSetSurface::kStrideX + at.y() * LevelSetSurface::kStrideY + at.z()];
      inside |= (phi < 0) << corner;
    }
    if (!(inside & 1)) return;
    solidEuler_ += kEulerOfCorners[inside];
    const std::uint32_t self = number(place, node);
    inside_[self] = true;
    for (int corner = 1; corner < 8; ++corner)
      if (inside >> corner & 1) sets_.unite(self, number(place, node + offset(corner)));
  }

  static Eigen::Vector3i offset(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2}; }

  const LevelSetSurface& surface_;
  std::vector<std::uint32_t> first_;  ///< number of the first node of each place
  std::vector<bool> inside_;
  UnionFind sets_{0};
  std::int64_t solidEuler_ = 0;
};

LevelSetTopology levelSetTopology(const LevelSetSurface& surface) {
  return LevelSetTopologyCounter(surface).count();
}

}  // namespace sinew
