#include "sinew/LevelSet/ShapeMeasures.h"

#include "sinew/LevelSet/FieldPieces.h"
#include "sinew/LevelSet/FieldVolume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace sinew {
namespace {

/// Calls `visit(index, fraction)` for every edge of the raster that the surface crosses, from the inside out:
/// the crossing lies at `fraction` of a sample from the inner end.
template <typename Visit>
void forCrossings(const DenseField& phi, const Visit& visit) {
  const Eigen::Vector3i last = phi.size - Eigen::Vector3i::Ones();
  for (int k = 0; k <= last.z(); ++k)
    for (int j = 0; j <= last.y(); ++j)
      for (int i = 0; i <= last.x(); ++i) {
        const float inner = phi(i, j, k);
        if (!(inner < 0)) continue;
        const Eigen::Vector3i at(i, j, k);
        for (int axis = 0; axis < 3; ++axis)
          for (const int side : {-1, 1}) {
            Eigen::Vector3i next = at;
            next[axis] += side;
            if (next[axis] < 0 || next[axis] > last[axis]) continue;
            const float outer = phi(next.x(), next.y(), next.z());
            if (!(outer < 0)) visit(at, axis, side, inner / (inner - outer));
          }
      }
}

/// Where two surfaces touch, CSG leaves samples near zero with nothing inside around them: they go out of
/// reach.
DenseField withoutFilms(const DenseLevelSet& levelSet) {
  DenseField field = levelSet.phi;
  const DenseField& phi = levelSet.phi;
  const auto away = static_cast<float>(levelSet.voxelSize), near = 0.5F * away;
  const auto anyInside = [&](int i, int j, int k) {
    for (int z = std::max(k - 1, 0); z <= std::min(k + 1, phi.size.z() - 1); ++z)
      for (int y = std::max(j - 1, 0); y <= std::min(j + 1, phi.size.y() - 1); ++y)
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, phi.size.x() - 1); ++x)
          if (phi(x, y, z) < 0) return true;
    return false;
  };
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    for (int j = 0; j < phi.size.y(); ++j) {
      const float* row = phi.row(j, k);
      for (int i = 0; i < phi.size.x(); ++i)
        if (row[i] >= 0 && row[i] < near && !anyInside(i, j, k)) field(i, j, k) = away;
    }
  });
  return field;
}

std::int64_t enclosed(const FieldPieces& pieces) { return std::ranges::count(pieces.atBorder, 0); }

}  // namespace

double shapeVolume(const DenseLevelSet& levelSet) {
  return fieldVolume(withoutFilms(levelSet), Eigen::Vector3d::Constant(levelSet.voxelSize));
}

Eigen::AlignedBox3d shapeBounds(const DenseLevelSet& levelSet) {
  Eigen::AlignedBox3d box;
  forCrossings(levelSet.phi, [&](const Eigen::Vector3i& at, int axis, int side, float fraction) {
    Eigen::Vector3d crossing = at.cast<double>();
    crossing[axis] += side * static_cast<double>(fraction);
    box.extend(levelSet.frame * (levelSet.voxelSize * crossing));
  });
  return box;
}

Eigen::Vector3d shapeCentroid(const DenseLevelSet& levelSet) {
  // A sample counts with the part of its voxel that a plane at its distance leaves: linear within half a
  // voxel.
  const DenseField& phi = levelSet.phi;
  const double inverse = 1 / levelSet.voxelSize;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double volume = 0;
  for (int k = 0; k < phi.size.z(); ++k)
    for (int j = 0; j < phi.size.y(); ++j) {
      const float* row = phi.row(j, k);
      for (int i = 0; i < phi.size.x(); ++i) {
        const double part = std::clamp(0.5 - row[i] * inverse, 0.0, 1.0);
        if (part == 0) continue;
        moment += part * Eigen::Vector3d(i, j, k);
        volume += part;
      }
    }
  if (volume == 0) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return levelSet.frame * (levelSet.voxelSize * (moment / volume));
}

ShapeTopology shapeTopology(const DenseLevelSet& levelSet) {
  const DenseField& phi = levelSet.phi;
  return {static_cast<std::int64_t>(fieldPieces(phi, true, Connectivity::Corners).samples.size()),
          enclosed(fieldPieces(phi, false, Connectivity::Faces))};
}

}  // namespace sinew
