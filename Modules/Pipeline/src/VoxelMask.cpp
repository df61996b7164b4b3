#include "VoxelMask.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace sinew {
namespace {

constexpr double kTolerance =
    1e-9;  // voxels: more than the rounding of a mapped node, so that shared faces leave no gap

using Corners = std::array<Eigen::Vector3d, 4>;

/// A half space a.x <= b, widened by kTolerance.
struct HalfSpace {
  Eigen::Vector3d normal;  ///< of any length
  double offset;
  double tolerance;  ///< kTolerance times the normal's length
};

/// The four half spaces of a tet of either orientation.
std::array<HalfSpace, 4> halfSpaces(const Corners& corners) {
  std::array<HalfSpace, 4> sides;
  for (int f = 0; f < 4; ++f) {
    const Eigen::Vector3d& a = corners[kTetFaces[f][0]];
    Eigen::Vector3d normal = (corners[kTetFaces[f][1]] - a).cross(corners[kTetFaces[f][2]] - a);
    if (normal.dot(corners[f] - a) > 0) normal = -normal;
    const double tolerance = kTolerance * normal.norm();
    sides[f] = {normal, normal.dot(a) + tolerance, tolerance};
  }
  return sides;
}

bool flat(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) == 0; }

void addTet(const Corners& corners, VoxelMask& mask) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : corners) box.extend(corner);
  const Eigen::Vector3i lower = (box.min().array() - kTolerance).ceil().cast<int>();
  const Eigen::Vector3i upper = (box.max().array() + kTolerance).floor().cast<int>();
  if ((lower.array() > upper.array()).any() || flat(corners)) return;
  const auto sides = halfSpaces(corners);
  for (int z = lower.z(); z <= upper.z(); ++z)
    for (int y = lower.y(); y <= upper.y(); ++y) {
      double first = lower.x(), last = upper.x();
      for (const HalfSpace& side : sides) {
        const double room = side.offset - side.normal.y() * y - side.normal.z() * z;  // >= normal.x * x
        if (side.normal.x() > side.tolerance)
          last = std::min(last, std::floor(room / side.normal.x()));
        else if (side.normal.x() < -side.tolerance)
          first = std::max(first, std::ceil(room / side.normal.x()));
        else if (room < 0)
          first = last + 1;
      }
      if (first <= last) mask.addRun(static_cast<int>(first), static_cast<int>(last), y, z);
    }
}

}  // namespace

VoxelMask::VoxelMask(const VoxelBox& box) : box_(box) {
  if (box.empty()) return;
  const Eigen::Vector3i size = box.upper - box.lower;
  wordsPerRow_ = (static_cast<std::size_t>(size.x()) + 63) / 64;
  words_.resize(wordsPerRow_ * size.y() * size.z());
}

std::size_t VoxelMask::rowStart(int y, int z) const {
  const std::size_t rows = box_.upper.y() - box_.lower.y();
  return ((z - box_.lower.z()) * rows + (y - box_.lower.y())) * wordsPerRow_;
}

bool VoxelMask::test(const Eigen::Vector3i& index) const {
  if ((index.array() < box_.lower.array()).any() || (index.array() >= box_.upper.array()).any()) return false;
  const std::size_t bit = index.x() - box_.lower.x();
  return words_[rowStart(index.y(), index.z()) + bit / 64] >> (bit % 64) & 1;
}

std::int64_t VoxelMask::count() const {
  std::int64_t count = 0;
  for (const std::uint64_t word : words_) count += std::popcount(word);
  return count;
}

void VoxelMask::addRun(int first, int last, int y, int z) {
  const std::size_t row = rowStart(y, z);
  const std::size_t from = first - box_.lower.x(), to = last - box_.lower.x();
  for (std::size_t word = from / 64; word <= to / 64; ++word) {
    const std::size_t low = word == from / 64 ? from % 64 : 0;
    const std::size_t high = word == to / 64 ? to % 64 : 63;
    const std::uint64_t bits = (~std::uint64_t{0} >> (63 - high)) & (~std::uint64_t{0} << low);
    std::atomic_ref(words_[row + word]).fetch_or(bits, std::memory_order_relaxed);
  }
}

void VoxelMask::flip(const Eigen::Vector3i& index) {
  const std::size_t bit = index.x() - box_.lower.x();
  words_[rowStart(index.y(), index.z()) + bit / 64] ^= std::uint64_t{1} << (bit % 64);
}

VoxelMask voxelsInMesh(const TetMesh& mesh, const Eigen::Affine3d& toIndex, const VoxelBox& atLeast) {
  std::vector<Eigen::Vector3d> nodes(mesh.nodes.size());
  Eigen::AlignedBox3d box;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n] = toIndex * mesh.nodes[n];
    box.extend(nodes[n]);
  }
  if (mesh.tets.empty()) return VoxelMask(atLeast);
  VoxelBox voxels{(box.min().array() - 1).floor().cast<int>(), (box.max().array() + 2).floor().cast<int>()};
  if (!atLeast.empty()) voxels = {voxels.lower.cwiseMin(atLeast.lower), voxels.upper.cwiseMax(atLeast.upper)};
  VoxelMask mask(voxels);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.tets.size(), 1024), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      const Tet& tet = mesh.tets[t];
      addTet({nodes[tet[0]], nodes[tet[1]], nodes[tet[2]], nodes[tet[3]]}, mask);
    }
  });
  return mask;
}

}  // namespace sinew
