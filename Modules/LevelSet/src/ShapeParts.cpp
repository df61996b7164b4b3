#include "sinew/LevelSet/ShapeParts.h"

#include "sinew/LevelSet/FieldPieces.h"
#include "sinew/LevelSet/Offset.h"
#include "sinew/LevelSet/Redistance.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

constexpr float kBeside = 0.1F;  ///< |phi| of samples that change side, at least; of the spacing

/// Pieces by size, the largest first; in raster order where they are equal.
std::vector<std::int32_t> bySize(const FieldPieces& pieces) {
  std::vector<std::int32_t> order(pieces.samples.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](std::int32_t id) { return pieces.samples[id]; });
  return order;
}

/// Turns the samples of the chosen pieces to the other side.
DenseLevelSet turned(const DenseLevelSet& levelSet, const FieldPieces& pieces,
                     const std::vector<bool>& chosen) {
  DenseLevelSet result = levelSet;
  const float least = kBeside * static_cast<float>(levelSet.voxelSize);
  for (std::size_t n = 0; n < result.phi.values.size(); ++n) {
    const std::int32_t id = pieces.ids.values[n];
    if (id < 0 || !chosen[static_cast<std::size_t>(id)]) continue;
    float& phi = result.phi.values[n];
    phi = std::copysign(std::max(std::abs(phi), least), phi < 0 ? 1.0F : -1.0F);
  }
  redistance(result);
  return result;
}

/// Without the pieces of one side for which `drop(id)`; the same level set where there are none.
DenseLevelSet without(const DenseLevelSet& levelSet, const FieldPieces& pieces,
                      const std::function<bool(std::int32_t)>& drop) {
  std::vector<bool> chosen(pieces.samples.size());
  for (std::size_t id = 0; id < chosen.size(); ++id) chosen[id] = drop(static_cast<std::int32_t>(id));
  return std::ranges::count(chosen, true) > 0 ? turned(levelSet, pieces, chosen) : levelSet;
}

double sampleVolume(const DenseLevelSet& levelSet) { return std::pow(levelSet.voxelSize, 3); }

std::vector<Eigen::AlignedBox3i> boxesOf(const FieldPieces& pieces) {
  std::vector<Eigen::AlignedBox3i> boxes(pieces.samples.size());
  const Eigen::Vector3i& size = pieces.ids.size;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j) {
      const std::int32_t* row = pieces.ids.row(j, k);
      for (int i = 0; i < size.x(); ++i)
        if (row[i] >= 0) boxes[static_cast<std::size_t>(row[i])].extend(Eigen::Vector3i(i, j, k));
    }
  return boxes;
}

/// For every piece of a part of the raster that begins at `lower`, the piece of the whole that it belongs to.
std::vector<std::int32_t> ownersOf(const FieldPieces& part, const FieldPieces& whole,
                                   const Eigen::Vector3i& lower) {
  std::vector<std::int32_t> owners(part.samples.size());
  const Eigen::Vector3i& size = part.ids.size;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) {
        const std::int32_t id = part.ids(i, j, k);
        if (id >= 0)
          owners[static_cast<std::size_t>(id)] = whole.ids(i + lower.x(), j + lower.y(), k + lower.z());
      }
  return owners;
}

/// Calls `visit(x, y, z)` for the samples around one, itself included, that lie in the raster.
template <typename Visit>
void forAround(const Eigen::Vector3i& size, int i, int j, int k, int reach, const Visit& visit) {
  for (int z = std::max(0, k - reach); z <= std::min(size.z() - 1, k + reach); ++z)
    for (int y = std::max(0, j - reach); y <= std::min(size.y() - 1, j + reach); ++y)
      for (int x = std::max(0, i - reach); x <= std::min(size.x() - 1, i + reach); ++x) visit(x, y, z);
}

/// What a closing adds to a shape, in pieces: negative there, positive elsewhere. Samples on the surface that
/// rounding turns are no addition.
DenseField additions(const DenseField& phi, const DenseField& closed, float rounding) {
  DenseField added(phi.size, 1);
  for (std::size_t n = 0; n < phi.values.size(); ++n) {
    const float before = phi.values[n], after = closed.values[n];
    if (before >= 0 && after < 0 && before - after > rounding) added.values[n] = -1;
  }
  return added;
}

/// How many mouths every piece has: connected parts of the outside that touch it. A cavity has none, a dent
/// or a groove one, the plug of a tunnel two or more.
std::vector<int> mouthsOf(const FieldPieces& pieces, const DenseField& closed) {
  const Eigen::Vector3i& size = pieces.ids.size;
  const std::vector<Eigen::AlignedBox3i> boxes = boxesOf(pieces);
  std::vector<int> mouths(pieces.samples.size());
  for (std::size_t id = 0; id < boxes.size(); ++id) {
    const Eigen::Vector3i lower = (boxes[id].min() - Eigen::Vector3i::Ones()).cwiseMax(0);
    const Eigen::Vector3i upper =
        (boxes[id].max() + Eigen::Vector3i::Ones()).cwiseMin(size - Eigen::Vector3i::Ones());
    DenseField beside(upper - lower + Eigen::Vector3i::Ones(), 1);
    for (int k = lower.z(); k <= upper.z(); ++k)
      for (int j = lower.y(); j <= upper.y(); ++j)
        for (int i = lower.x(); i <= upper.x(); ++i) {
          if (pieces.ids(i, j, k) != static_cast<std::int32_t>(id)) continue;
          forAround(size, i, j, k, 1, [&](int x, int y, int z) {
            if (closed(x, y, z) >= 0) beside(x - lower.x(), y - lower.y(), z - lower.z()) = -1;
          });
        }
    mouths[id] = static_cast<int>(fieldPieces(beside, true, Connectivity::Corners).samples.size());
  }
  return mouths;
}

}  // namespace

std::vector<DenseLevelSet> shapeComponents(const DenseLevelSet& levelSet) {
  const FieldPieces pieces = fieldPieces(levelSet.phi, true, Connectivity::Corners);
  const std::vector<Eigen::AlignedBox3i> boxes = boxesOf(pieces);
  const Eigen::Vector3i margin =
      Eigen::Vector3i::Constant(static_cast<int>(std::ceil(levelSet.band / levelSet.voxelSize)) + 1);
  std::vector<DenseLevelSet> components;
  for (const std::int32_t id : bySize(pieces)) {
    const Eigen::AlignedBox3i& box = boxes[static_cast<std::size_t>(id)];
    const Eigen::Vector3i lower = box.min() - margin;
    DenseLevelSet component = onBox(levelSet, lower, box.max() + margin);
    const FieldPieces local = fieldPieces(component.phi, true, Connectivity::Corners);
    const std::vector<std::int32_t> owner = ownersOf(local, pieces, lower);
    components.push_back(
        without(component, local, [&](std::int32_t n) { return owner[static_cast<std::size_t>(n)] != id; }));
  }
  return components;
}

DenseLevelSet keepLargest(const DenseLevelSet& levelSet, int count) {
  if (count < 1)
    throw std::invalid_argument("keepLargest: count must be at least 1, got " + std::to_string(count));
  const FieldPieces pieces = fieldPieces(levelSet.phi, true, Connectivity::Corners);
  const std::vector<std::int32_t> order = bySize(pieces);
  std::vector<bool> small(order.size());
  for (std::size_t rank = static_cast<std::size_t>(count); rank < order.size(); ++rank)
    small[static_cast<std::size_t>(order[rank])] = true;
  return without(levelSet, pieces, [&](std::int32_t id) { return small[static_cast<std::size_t>(id)]; });
}

DenseLevelSet dropSmall(const DenseLevelSet& levelSet, double least) {
  const FieldPieces pieces = fieldPieces(levelSet.phi, true, Connectivity::Corners);
  const double sample = sampleVolume(levelSet);
  return without(levelSet, pieces, [&](std::int32_t id) {
    return static_cast<double>(pieces.samples[static_cast<std::size_t>(id)]) * sample < least;
  });
}

DenseLevelSet fillCavities(const DenseLevelSet& levelSet, double most) {
  const FieldPieces hollows = fieldPieces(levelSet.phi, false, Connectivity::Faces);
  const double sample = sampleVolume(levelSet);
  return without(levelSet, hollows, [&](std::int32_t id) {
    const auto n = static_cast<std::size_t>(id);
    return hollows.atBorder[n] == 0 && static_cast<double>(hollows.samples[n]) * sample <= most;
  });
}

DenseLevelSet fillHoles(const DenseLevelSet& levelSet, double width) {
  if (!(width > 0))
    throw std::invalid_argument("fillHoles: width must be positive, got " + std::to_string(width));
  const SampleLattice lattice{levelSet.frame, levelSet.voxelSize};
  DenseLevelSet closed = closing(levelSet, width / 2);
  const Eigen::Vector3i first = firstSampleOn(lattice, closed).value();
  closed = onBox(closed, -first, levelSet.phi.size - Eigen::Vector3i::Ones() - first);

  const FieldPieces added =
      fieldPieces(additions(levelSet.phi, closed.phi, kBeside * static_cast<float>(levelSet.voxelSize)), true,
                  Connectivity::Corners);
  const std::vector<int> mouths = mouthsOf(added, closed.phi);
  if (std::ranges::count(mouths, 1) == std::ssize(mouths)) return levelSet;
  DenseLevelSet result = levelSet;
  const Eigen::Vector3i& size = levelSet.phi.size;
  constexpr int kRim = 2;  // samples beside a plug that see its surface too
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) {
        const std::int32_t id = added.ids(i, j, k);
        if (id < 0 || mouths[static_cast<std::size_t>(id)] == 1) continue;
        forAround(size, i, j, k, kRim, [&](int x, int y, int z) {
          const std::int32_t other = added.ids(x, y, z);
          if (other < 0 || mouths[static_cast<std::size_t>(other)] != 1)
            result.phi(x, y, z) = std::min(levelSet.phi(x, y, z), closed.phi(x, y, z));
        });
      }
  redistance(result);
  return result;
}

}  // namespace sinew
