#include "sinew/Mesher/LatticeMesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace sinew {
namespace {

constexpr double kOutsideEdges =
    2;  // a tet whose nodes are all deeper outside than this many edges is dropped

std::vector<double> sampleNodes(const std::vector<Int3>& nodes, const LatticeFrame& frame,
                                const SignedDistance& phi) {
  std::vector<double> values(nodes.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 4096), [&](const auto& range) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) values[n] = phi.value(frame.position(nodes[n]));
  });
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
  std::vector<Tet> tets;
  std::size_t count = 0;
  for (const auto& layer : layers) count += layer.size();
  tets.reserve(count);
  for (auto& layer : layers) {
    tets.insert(tets.end(), layer.begin(), layer.end());
    std::vector<Tet>().swap(layer);
  }
  return tets;
}

}  // namespace

NodeStars nodeStars(std::size_t nodes, const std::vector<Tet>& tets) {
  NodeStars stars;
  stars.offsets.assign(nodes + 1, 0);
  for (const Tet& tet : tets) {
    for (const std::int32_t v : tet) ++stars.offsets[v + 1];
  }
  for (std::size_t n = 0; n < nodes; ++n) stars.offsets[n + 1] += stars.offsets[n];
  stars.tets.resize(4 * tets.size());
  std::vector<std::int32_t> next(stars.offsets.begin(), stars.offsets.end() - 1);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (const std::int32_t v : tets[t]) stars.tets[next[v]++] = static_cast<std::int32_t>(t);
  }
  return stars;
}

LatticeMesh latticeMesh(const RedGreenLattice& lattice, const LatticePlan& plan, const SignedDistance& phi) {
  const std::vector<Int3> nodes = lattice.nodes().nodes();
  const std::vector<double> values = sampleNodes(nodes, plan.frame, phi);
  LatticeMesh mesh;
  mesh.tets = collectLeaves(lattice, plan, values);

  std::vector<std::int32_t> compact(nodes.size(), -1);
  for (const Tet& tet : mesh.tets) {
    for (const std::int32_t v : tet) compact[v] = 0;
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (compact[n] < 0) continue;
    compact[n] = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.push_back(plan.frame.position(nodes[n]));
    mesh.phi.push_back(values[n]);
  }
  for (Tet& tet : mesh.tets) {
    for (std::int32_t& v : tet) v = compact[v];
  }
  return mesh;
}

}  // namespace sinew
