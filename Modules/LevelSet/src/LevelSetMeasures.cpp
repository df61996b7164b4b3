#include "sinew/LevelSet/LevelSetMeasures.h"

#include "BccTopology.h"
#include "VoxelFraction.h"
#include "sinew/LevelSet/LevelSetGrid.h"

#include <openvdb/tools/Dense.h>
#include <openvdb/tree/LeafManager.h>
#include <tbb/parallel_reduce.h>

#include <functional>

namespace sinew {
namespace {

using Tree = openvdb::FloatTree;

/// Voxels' worth of phi < 0 in one leaf.
double leafVolume(const Tree::LeafNodeType& leaf, const openvdb::tree::ValueAccessor<const Tree>& phi,
                  double voxelSize) {
  const Eigen::Vector3d spacing = Eigen::Vector3d::Constant(voxelSize);
  const double reach = kCutReach * spacing.norm();
  double voxels = 0;
  for (auto it = leaf.cbeginValueAll(); it; ++it) {
    if (*it >= reach) continue;
    if (*it <= -reach) {
      voxels += 1;
      continue;
    }
    const openvdb::Coord at = it.getCoord();
    const auto value = [&](int a, int side) -> double {
      openvdb::Coord n = at;
      n[a] += side;
      return phi.getValue(n);
    };
    voxels += voxelFraction(
        {*it, {value(0, -1), value(1, -1), value(2, -1)}, {value(0, 1), value(1, 1), value(2, 1)}}, spacing,
        0);
  }
  return voxels;
}

/// Voxels in inside tiles, above the leaves.
double tileVolume(const Tree& tree) {
  double voxels = 0;
  auto it = tree.cbeginValueAll();
  it.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; it; ++it)
    if (*it < 0) voxels += static_cast<double>(it.getVoxelCount());
  return voxels;
}

}  // namespace

double levelSetVolume(const LevelSet& levelSet) {
  const Tree& tree = levelSet.grid->grid->constTree();
  const openvdb::tree::LeafManager<const Tree> leaves(tree);
  const double inLeaves = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, leaves.leafCount(), 16), 0.0,
      [&](const tbb::blocked_range<std::size_t>& range, double sum) {
        const openvdb::tree::ValueAccessor<const Tree> phi(tree);
        for (std::size_t n = range.begin(); n < range.end(); ++n)
          sum += leafVolume(leaves.leaf(n), phi, levelSet.voxelSize);
        return sum;
      },
      std::plus<>());
  return (inLeaves + tileVolume(tree)) * levelSet.voxelSize * levelSet.voxelSize * levelSet.voxelSize;
}

LevelSetTopology levelSetTopology(const LevelSet& levelSet) {
  const openvdb::FloatGrid& grid = *levelSet.grid->grid;
  openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) return {};
  box.expand(3);
  BccTopology topology(box.dim().x(), box.dim().y());
  constexpr int kSlab = 8;
  using Slab = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;
  for (int z = box.min().z(); z <= box.max().z(); z += kSlab) {
    const int last = std::min(z + kSlab - 1, box.max().z());
    Slab slab(openvdb::CoordBBox({box.min().x(), box.min().y(), z}, {box.max().x(), box.max().y(), last}));
    openvdb::tools::copyToDense(grid, slab);
    for (int k = 0; k <= last - z; ++k)
      topology.addSlice(slab.data() + slab.zStride() * static_cast<std::size_t>(k));
  }
  return {topology.components(), topology.eulerCharacteristic()};
}

}  // namespace sinew
