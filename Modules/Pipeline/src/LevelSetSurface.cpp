#include "LevelSetSurface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace sinew {
namespace {

/// The nodes of one brick: values of a raster, and `beyond` around it.
class BrickReader {
 public:
  static constexpr int kNodes = 9;

  BrickReader(const DenseField& phi, float beyond) : phi_(phi), beyond_(beyond) {}

  /// Gives visit(x, y, z, value) the nodes from `first` on, x fastest, until it returns false.
  template <typename Visit>
  bool visit(const Eigen::Vector3i& first, const Visit& visit) const {
    for (int z = 0; z < kNodes; ++z)
      for (int y = 0; y < kNodes; ++y) {
        const int j = first.y() + y, k = first.z() + z;
        const bool outside = j < 0 || k < 0 || j >= phi_.size.y() || k >= phi_.size.z();
        const float* row = outside ? nullptr : phi_.row(j, k);
        for (int x = 0; x < kNodes; ++x) {
          const int i = first.x() + x;
          const float value = outside || i < 0 || i >= phi_.size.x() ? beyond_ : row[i];
          if (!visit(x, y, z, value)) return false;
        }
      }
    return true;
  }

 private:
  const DenseField& phi_;
  float beyond_;
};

}  // namespace

LevelSetSurface::LevelSetSurface(const DenseLevelSet& levelSet)
    : voxelSize_(levelSet.voxelSize),
      inverseVoxelSize_(1 / levelSet.voxelSize),
      band_(levelSet.band),
      bounds_(Eigen::Vector3d::Zero(),
              levelSet.voxelSize * (levelSet.phi.size.array() - 1).cast<double>().matrix()),
      // The cells beside the raster still mix its values with the band.
      origin_(Eigen::Vector3i::Constant(-1)),
      count_((levelSet.phi.size.array() + kCells) / kCells),
      extent_((count_ * kCells).cast<double>()),
      table_(static_cast<std::size_t>(count_.x()) * count_.y() * count_.z()) {
  static_assert(BrickReader::kNodes == kNodes);
  const auto band = static_cast<float>(band_);
  const BrickReader reader(levelSet.phi, band);
  const auto first = [&](int x, int y, int z) -> Eigen::Vector3i {
    return origin_ + kCells * Eigen::Vector3i(x, y, z);
  };
  constexpr std::uint32_t kBanded = kOutside + 1;
  tbb::parallel_for(0, count_.x(), [&](int x) {
    for (int y = 0; y < count_.y(); ++y)
      for (int z = 0; z < count_.z(); ++z) {
        std::array<bool, 3> has{};  // -band, +band, values of its own
        const bool constant = reader.visit(first(x, y, z), [&](int, int, int, float value) {
          has[value == -band ? kInside : value == band ? kOutside : kBanded] = true;
          return has[kInside] + has[kOutside] + 2 * has[kBanded] < 2;
        });
        table_[entry({x, y, z})] = !constant ? kBanded : has[kInside] ? kInside : kOutside;
      }
  });
  std::uint32_t bricks = kBanded;
  for (std::uint32_t& brick : table_)
    if (brick == kBanded) brick = bricks++;

  values_.resize(bricks * kBrickSize);
  std::fill_n(values_.begin() + kInside * kBrickSize, kBrickSize, -band);
  std::fill_n(values_.begin() + kOutside * kBrickSize, kBrickSize, band);
  tbb::parallel_for(0, count_.x(), [&](int x) {
    for (int y = 0; y < count_.y(); ++y)
      for (int z = 0; z < count_.z(); ++z) {
        const std::uint32_t brick = table_[entry({x, y, z})];
        if (brick < kBanded) continue;
        float* out = values_.data() + brick * kBrickSize;
        reader.visit(first(x, y, z), [&](int i, int j, int k, float value) {
          out[i * kStrideX + j * kStrideY + k] = value;
          return true;
        });
      }
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
