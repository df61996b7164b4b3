#include "sinew/Mesher/LatticeMesh.h"

#include "Parallel.h"

#include <algorithm>
#include <utility>

namespace sinew {
namespace {

constexpr double kOutsideEdges =
    2;  // a tet whose nodes are all deeper outside than this many edges is dropped

constexpr std::size_t kParts = 4;  // of the tets, for the stars
constexpr std::size_t kSmall = 1 << 15;

std::vector<double> sampleNodes(const std::vector<Int3>& nodes, const LatticeFrame& frame,
                                const SignedDistance& phi) {
  std::vector<double> values(nodes.size());
  forEach(nodes.size(), [&](std::size_t n) { values[n] = phi.value(frame.position(nodes[n])); });
  return values;
}

/// Leaves near or inside the shape, in terms of lattice node indices; layer by layer of coarse cubes in
/// parallel.
std::vector<Tet> collectLeaves(const RedGreenLattice& lattice, const LatticePlan& plan,
                               const std::vector<double>& phi) {
  const Int3 n = lattice.coarseCells();
  const auto indices = [&](const std::array<Int3, 4>& nodes) {
    Tet tet;
    for (int v = 0; v < 4; ++v) tet[v] = lattice.nodes().indexOf(nodes[v]);
    return tet;
  };
  const auto lowest = [&](const Tet& tet) {
    return std::min(std::min(phi[tet[0]], phi[tet[1]]), std::min(phi[tet[2]], phi[tet[3]]));
  };
  std::vector<std::vector<Tet>> layers(n.z);
  tbb::parallel_for(1, n.z - 1, [&](int z) {
    const auto enter = [&](int level, const std::array<Int3, 4>& nodes) {
      return lowest(indices(nodes)) < (kOutsideEdges + 1) * plan.cubeSize(level);
    };
    const auto emit = [&](const LatticeTet& leaf) {
      const Tet tet = indices(leaf.nodes);
      if (lowest(tet) < kOutsideEdges * plan.cubeSize(leaf.level)) layers[z].push_back(tet);
    };
    for (int y = 1; y < n.y - 1; ++y) {
      for (int x = 1; x < n.x - 1; ++x) {
        for (const BccTet& tet : RedGreenLattice::coarseTets({x, y, z}))
          lattice.forEachLeaf(0, tet, enter, emit);
      }
    }
  });
  return concatenated(std::move(layers));
}

}  // namespace

NodeStars nodeStars(std::size_t nodes, const std::vector<Tet>& tets) {
  // Parts of the tets count and write on their own; in a row the tets of an earlier part come first.
  const std::size_t parts = tets.size() < kSmall ? 1 : kParts;
  const auto forEachPart = [&](const auto& f) {
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
      const std::size_t end = (part + 1) * tets.size() / parts;
      for (std::size_t t = part * tets.size() / parts; t < end; ++t)
        for (const std::int32_t v : tets[t]) f(part, v, static_cast<std::int32_t>(t));
    });
  };
  std::vector<std::vector<std::int32_t>> next(parts);
  for (auto& counts : next) counts.assign(nodes, 0);
  forEachPart([&](std::size_t part, std::int32_t v, std::int32_t) { ++next[part][v]; });
  NodeStars stars;
  stars.offsets.resize(nodes + 1);
  std::int32_t begin = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    stars.offsets[n] = begin;
    for (auto& counts : next) begin += std::exchange(counts[n], begin);
  }
  stars.offsets[nodes] = begin;
  stars.tets.resize(4 * tets.size());
  forEachPart([&](std::size_t part, std::int32_t v, std::int32_t t) { stars.tets[next[part][v]++] = t; });
  return stars;
}

LatticeMesh latticeMesh(const RedGreenLattice& lattice, const LatticePlan& plan, const SignedDistance& phi) {
  const std::vector<Int3> nodes = lattice.nodes().nodes();
  const std::vector<double> values = sampleNodes(nodes, plan.frame, phi);
  LatticeMesh mesh;
  mesh.tets = collectLeaves(lattice, plan, values);

  std::vector<std::uint8_t> used(nodes.size(), 0);
  forEach(mesh.tets.size(), [&](std::size_t t) {
    for (const std::int32_t v : mesh.tets[t]) setFlag(used[v]);
  });
  std::vector<std::int32_t> compact(nodes.size());
  std::int32_t count = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    compact[n] = count;
    count += used[n];
  }
  mesh.positions.resize(count);
  mesh.phi.resize(count);
  forEach(nodes.size(), [&](std::size_t n) {
    if (used[n] == 0) return;
    mesh.positions[compact[n]] = plan.frame.position(nodes[n]);
    mesh.phi[compact[n]] = values[n];
  });
  forEach(mesh.tets.size(), [&](std::size_t t) {
    for (std::int32_t& v : mesh.tets[t]) v = compact[v];
  });
  return mesh;
}

}  // namespace sinew
