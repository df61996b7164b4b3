#include "sinew/LevelSet/SmallPieces.h"

#include <algorithm>
#include <stdexcept>

namespace sinew {
namespace {

/// Collects the piece of a voxel; empty when it has a voxel inside the field or is too large.
class PieceFinder {
 public:
  PieceFinder(const DenseField& field, const DenseMask& mask, int mostVoxels)
      : field_(field), mask_(mask), mostVoxels_(static_cast<std::size_t>(mostVoxels)) {}

  std::vector<std::size_t> lostPiece(const Eigen::Vector3i& start) const {
    std::vector<Eigen::Vector3i> piece{start};
    std::vector<std::size_t> indices{indexOf(start)};
    for (std::size_t next = 0; next < piece.size(); ++next) {
      const Eigen::Vector3i low = (piece[next].array() - 1).max(0),
                            high = (piece[next].array() + 1).min(mask_.size.array() - 1);
      for (int k = low.z(); k <= high.z(); ++k) {
        for (int j = low.y(); j <= high.y(); ++j) {
          for (int i = low.x(); i <= high.x(); ++i) {
            const std::size_t n = mask_.index(i, j, k);
            if (mask_.values[n] == 0 || std::find(indices.begin(), indices.end(), n) != indices.end())
              continue;
            if (field_.values[n] < 0 || indices.size() == mostVoxels_) return {};
            piece.emplace_back(i, j, k);
            indices.push_back(n);
          }
        }
      }
    }
    return indices;
  }

 private:
  std::size_t indexOf(const Eigen::Vector3i& at) const { return mask_.index(at.x(), at.y(), at.z()); }

  const DenseField& field_;
  const DenseMask& mask_;
  std::size_t mostVoxels_;
};

}  // namespace

int restoreSmallPieces(DenseField& field, const DenseMask& mask, float inside, int mostVoxels) {
  if (field.size != mask.size || !(inside < 0))
    throw std::invalid_argument("restoreSmallPieces: sizes must agree and `inside` must be negative");
  const PieceFinder finder(field, mask, mostVoxels);
  int pieces = 0;
  for (int k = 0; k < mask.size.z(); ++k) {
    for (int j = 0; j < mask.size.y(); ++j) {
      for (int i = 0; i < mask.size.x(); ++i) {
        if (mask(i, j, k) == 0 || field(i, j, k) < 0) continue;
        const std::vector<std::size_t> piece = finder.lostPiece({i, j, k});
        for (const std::size_t n : piece) field.values[n] = inside;
        pieces += piece.empty() ? 0 : 1;
      }
    }
  }
  return pieces;
}

}  // namespace sinew
