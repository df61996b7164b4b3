#include "LevelSetSurface.h"

#include "sinew/LevelSet/LevelSetGrid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sinew {
namespace {

/// The values that one leaf of the tree gives to a brick and its lower neighbours.
struct Source {
  const float* leaf = nullptr;  ///< 8^3 values, z fastest; nullptr for a tile
  float tile = 0;               ///< the value of all of a tile

  float at(int x, int y, int z) const { return leaf ? leaf[(x * 8 + y) * 8 + z] : tile; }
};

Source sourceAt(const openvdb::FloatTree& tree, const openvdb::Coord& origin) {
  if (const auto* leaf = tree.probeConstLeaf(origin)) return {leaf->buffer().data(), 0};
  return {nullptr, tree.getValue(origin)};
}

int floorToMultipleOf8(int index) { return index & ~7; }

}  // namespace

LevelSetSurface::LevelSetSurface(const LevelSet& levelSet)
    : voxelSize_(levelSet.voxelSize),
      inverseVoxelSize_(1 / levelSet.voxelSize),
      band_(levelSet.band),
      bounds_(levelSet.voxelSize * levelSet.lower.cast<double>(),
              levelSet.voxelSize * levelSet.upper.cast<double>()),
      // The cells beside the box still mix values of the box with the background.
      origin_((levelSet.lower.array() - 1).unaryExpr(&floorToMultipleOf8)),
      count_((levelSet.upper - origin_).array() / kCells + 1),
      extent_((count_ * kCells).cast<double>()),
      table_(static_cast<std::size_t>(count_.x()) * count_.y() * count_.z()) {
  const openvdb::FloatTree& tree = levelSet.grid->grid->constTree();
  // One layer more than bricks: a brick's last nodes lie in the next leaves.
  const Eigen::Vector3i sourceCount = count_.array() + 1;
  std::vector<Source> sources(static_cast<std::size_t>(sourceCount.x()) * sourceCount.y() * sourceCount.z());
  const auto sourceOf = [&](int x, int y, int z) -> Source& {
    return sources[(static_cast<std::size_t>(x) * sourceCount.y() + y) * sourceCount.z() + z];
  };
  tbb::parallel_for(0, sourceCount.x(), [&](int x) {
    for (int y = 0; y < sourceCount.y(); ++y)
      for (int z = 0; z < sourceCount.z(); ++z)
        sourceOf(x, y, z) =
            sourceAt(tree, openvdb::Coord(origin_.x() + 8 * x, origin_.y() + 8 * y, origin_.z() + 8 * z));
  });

  std::vector<Eigen::Vector3i> banded;  // places of the bricks with values of their own
  std::uint32_t bricks = kOutside + 1;
  for (int x = 0; x < count_.x(); ++x)
    for (int y = 0; y < count_.y(); ++y)
      for (int z = 0; z < count_.z(); ++z) {
        const float first = sourceOf(x, y, z).tile;
        bool constant = true;
        for (int corner = 0; corner < 8 && constant; ++corner) {
          const Source& source = sourceOf(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
          constant = !source.leaf && source.tile == first;
        }
        if (!constant) banded.push_back({x, y, z});
        table_[entry({x, y, z})] = !constant ? bricks++ : first < 0 ? kInside : kOutside;
      }

  values_.resize(bricks * kBrickSize);
  std::fill_n(values_.begin() + kInside * kBrickSize, kBrickSize, -static_cast<float>(band_));
  std::fill_n(values_.begin() + kOutside * kBrickSize, kBrickSize, static_cast<float>(band_));
  tbb::parallel_for(std::size_t{0}, banded.size(), [&](std::size_t b) {
    const Eigen::Vector3i& place = banded[b];
    float* out = values_.data() + table_[entry(place)] * kBrickSize;
    for (int x = 0; x < kNodes; ++x)
      for (int y = 0; y < kNodes; ++y)
        for (int z = 0; z < kNodes; ++z)
          *out++ = sourceOf(place.x() + x / 8, place.y() + y / 8, place.z() + z / 8).at(x % 8, y % 8, z % 8);
  });
}

std::size_t LevelSetSurface::entry(const Eigen::Vector3i& position) const {
  return (static_cast<std::size_t>(position.x()) * count_.y() + position.y()) * count_.z() + position.z();
}

const float* LevelSetSurface::brick(const Eigen::Vector3i& position) const {
  return values_.data() + table_[entry(position)] * kBrickSize;
}

std::vector<Eigen::Vector3i> LevelSetSurface::bandBricks() const {
  std::vector<Eigen::Vector3i> bricks;
  for (int x = 0; x < count_.x(); ++x)
    for (int y = 0; y < count_.y(); ++y)
      for (int z = 0; z < count_.z(); ++z)
        if (table_[entry({x, y, z})] > kOutside)
          bricks.push_back(origin_ + kCells * Eigen::Vector3i(x, y, z));
  return bricks;
}

float LevelSetSurface::atNode(const Eigen::Vector3i& index) const {
  const Eigen::Vector3i node = index - origin_, place = node / kCells, in = node - kCells * place;
  if ((node.array() < 0).any() || (place.array() >= count_.array()).any()) return static_cast<float>(band_);
  return brick(place)[in.x() * kStrideX + in.y() * kStrideY + in.z()];
}

LevelSetSurface::Cell LevelSetSurface::cellAt(const Eigen::Vector3d& x) const {
  const Eigen::Vector3d position = x * inverseVoxelSize_ - origin_.cast<double>();
  if (!((position.array() >= 0).all() && (position.array() < extent_.array()).all()))
    return {nullptr, position};
  const Eigen::Vector3i cell = position.cast<int>();  // truncation is floor here
  const auto place = [&](int axis) { return static_cast<std::size_t>(cell[axis] >> kLog2Cells); };
  const auto inside = [&](int axis) { return cell[axis] & (kCells - 1); };
  const std::size_t entry = (place(0) * count_.y() + place(1)) * count_.z() + place(2);
  return {
      values_.data() + table_[entry] * kBrickSize + (inside(0) * kStrideX + inside(1) * kStrideY + inside(2)),
      position - cell.cast<double>()};
}

double LevelSetSurface::value(const Eigen::Vector3d& x) const {
  const Cell cell = cellAt(x);
  if (!cell.lower) return band_;
  const auto alongZ = [&](int corner) {
    const double lower = cell.lower[corner], upper = cell.lower[corner + 1];
    return lower + cell.fraction.z() * (upper - lower);
  };
  const auto alongY = [&](int corner) {
    const double lower = alongZ(corner), upper = alongZ(corner + kStrideY);
    return lower + cell.fraction.y() * (upper - lower);
  };
  const double lower = alongY(0), upper = alongY(kStrideX);
  return lower + cell.fraction.x() * (upper - lower);
}

double LevelSetSurface::valueAndGradient(const Eigen::Vector3d& x, Eigen::Vector3d& gradient) const {
  const Cell cell = cellAt(x);
  if (!cell.lower) {
    gradient.setZero();
    return band_;
  }
  // Each axis that is folded away turns the slopes along the others into their interpolated values.
  struct Edge {
    double value, dz;
  };
  struct Face {
    double value, dy, dz;
  };
  const auto edge = [&](int corner) -> Edge {
    const double lower = cell.lower[corner], upper = cell.lower[corner + 1];
    return {lower + cell.fraction.z() * (upper - lower), upper - lower};
  };
  const auto face = [&](int corner) -> Face {
    const Edge lower = edge(corner), upper = edge(corner + kStrideY);
    const double t = cell.fraction.y();
    return {lower.value + t * (upper.value - lower.value), upper.value - lower.value,
            lower.dz + t * (upper.dz - lower.dz)};
  };
  const Face lower = face(0), upper = face(kStrideX);
  const double t = cell.fraction.x();
  gradient = Eigen::Vector3d(upper.value - lower.value, lower.dy + t * (upper.dy - lower.dy),
                             lower.dz + t * (upper.dz - lower.dz)) *
             inverseVoxelSize_;
  return lower.value + t * (upper.value - lower.value);
}

}  // namespace sinew
