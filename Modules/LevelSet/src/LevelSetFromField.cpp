#include "sinew/LevelSet/LevelSetFromField.h"

#include "GridTransform.h"
#include "sinew/LevelSet/LevelSetGrid.h"

#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace sinew {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
constexpr int kLeaf = static_cast<int>(Leaf::DIM);

/// The leaf whose first sample is `origin`, or null where the band does not reach.
Leaf* makeLeaf(const DenseField& phi, const openvdb::Coord& origin, float band, float offset) {
  const openvdb::Coord end(std::min(origin.x() + kLeaf, phi.size.x()),
                           std::min(origin.y() + kLeaf, phi.size.y()),
                           std::min(origin.z() + kLeaf, phi.size.z()));
  const auto anyInBand = [&] {
    for (int k = origin.z(); k < end.z(); ++k)
      for (int j = origin.y(); j < end.y(); ++j) {
        const float* row = phi.row(j, k);
        for (int i = origin.x(); i < end.x(); ++i)
          if (std::abs(row[i] - offset) < band) return true;
      }
    return false;
  };
  if (!anyInBand()) return nullptr;
  auto* leaf = new Leaf(origin, band, false);
  float* buffer = leaf->buffer().data();
  Leaf::NodeMaskType& active = leaf->getValueMask();
  for (int i = origin.x(); i < end.x(); ++i)
    for (int j = origin.y(); j < end.y(); ++j)
      for (int k = origin.z(); k < end.z(); ++k) {
        const openvdb::Index n = Leaf::coordToOffset({i, j, k});
        const float value = std::clamp(phi(i, j, k) - offset, -band, band);
        buffer[n] = value;
        if (std::abs(value) < band) active.setOn(n);
      }
  return leaf;
}

}  // namespace

LevelSet levelSetFromField(const DenseLevelSet& dense, double offset) {
  if (!(dense.voxelSize > 0) || !(dense.band > 0))
    throw std::invalid_argument("levelSetFromField: voxelSize and band must be positive");
  openvdb::initialize();
  const auto band = static_cast<float>(dense.band), shift = static_cast<float>(offset);
  auto grid = openvdb::FloatGrid::create(band);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setTransform(gridTransform(dense.frame, dense.voxelSize));

  const Eigen::Vector3i blocks = (dense.phi.size.array() + kLeaf - 1) / kLeaf;
  std::vector<std::vector<Leaf*>> leaves(static_cast<std::size_t>(blocks.z()));
  tbb::parallel_for(0, blocks.z(), [&](int k) {
    for (int j = 0; j < blocks.y(); ++j)
      for (int i = 0; i < blocks.x(); ++i)
        if (Leaf* leaf = makeLeaf(dense.phi, {i * kLeaf, j * kLeaf, k * kLeaf}, band, shift))
          leaves[static_cast<std::size_t>(k)].push_back(leaf);
  });
  for (const std::vector<Leaf*>& slab : leaves)
    for (Leaf* leaf : slab) grid->tree().addLeaf(leaf);
  openvdb::tools::signedFloodFill(grid->tree());

  LevelSet result;
  result.grid = std::make_shared<LevelSetGrid>(LevelSetGrid{grid});
  result.frame = dense.frame;
  result.voxelSize = dense.voxelSize;
  result.band = dense.band;
  result.upper = dense.phi.size - Eigen::Vector3i::Ones();
  return result;
}

DenseLevelSet fieldFromLevelSet(const LevelSet& levelSet) {
  const Eigen::Vector3i &lower = levelSet.lower, &upper = levelSet.upper;
  DenseLevelSet dense;
  dense.phi = DenseField(upper - lower + Eigen::Vector3i::Ones());
  using Raster = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;
  Raster raster(openvdb::CoordBBox({lower.x(), lower.y(), lower.z()}, {upper.x(), upper.y(), upper.z()}),
                dense.phi.values.data());
  openvdb::tools::copyToDense(*levelSet.grid->grid, raster);
  dense.frame = levelSet.frame * Eigen::Translation3d(levelSet.voxelSize * lower.cast<double>());
  dense.voxelSize = levelSet.voxelSize;
  dense.band = levelSet.band;
  return dense;
}

}  // namespace sinew
