#include "sinew/LevelSet/SampleLattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {
namespace {

constexpr double kSameSample = 1e-3;  // of the spacing
constexpr double kFarthest = 1e9;     // samples; beyond, an index is no int

}  // namespace

std::optional<Eigen::Vector3i> firstSampleOn(const SampleLattice& lattice, const DenseLevelSet& levelSet) {
  const double h = lattice.spacing;
  if (levelSet.phi.values.empty()) return std::nullopt;
  const Eigen::Vector3d last = (levelSet.phi.size - Eigen::Vector3i::Ones()).cast<double>();
  const auto indexOf = [&](const Eigen::Vector3d& sample) -> Eigen::Vector3d {
    return lattice.frame.inverse() * (levelSet.frame * (levelSet.voxelSize * sample)) / h;
  };
  const Eigen::Vector3d first = indexOf(Eigen::Vector3d::Zero());
  if (!(first.cwiseAbs().maxCoeff() < kFarthest)) return std::nullopt;
  const Eigen::Vector3i index = first.array().round().cast<int>();
  const bool same = (first - index.cast<double>()).cwiseAbs().maxCoeff() < kSameSample &&
                    (indexOf(last) - first - last).cwiseAbs().maxCoeff() < kSameSample;
  return same ? std::optional(index) : std::nullopt;
}

DenseLevelSet emptyLevelSet(const SampleLattice& lattice, const Eigen::Vector3i& lower,
                            const Eigen::Vector3i& upper, double band) {
  DenseLevelSet result;
  result.phi = DenseField((upper - lower + Eigen::Vector3i::Ones()).cwiseMax(0), static_cast<float>(band));
  result.frame = lattice.frame * Eigen::Translation3d(lattice.spacing * lower.cast<double>());
  result.voxelSize = lattice.spacing;
  result.band = band;
  return result;
}

DenseLevelSet onBox(const DenseLevelSet& levelSet, const Eigen::Vector3i& lower,
                    const Eigen::Vector3i& upper) {
  DenseLevelSet result = emptyLevelSet({levelSet.frame, levelSet.voxelSize}, lower, upper, levelSet.band);
  const Eigen::Vector3i from = lower.cwiseMax(0),
                        to = (upper + Eigen::Vector3i::Ones()).cwiseMin(levelSet.phi.size);
  if ((to.array() <= from.array()).any()) return result;
  tbb::parallel_for(from.z(), to.z(), [&](int k) {
    for (int j = from.y(); j < to.y(); ++j) {
      const float* row = levelSet.phi.row(j, k);
      std::copy(row + from.x(), row + to.x(),
                result.phi.row(j - lower.y(), k - lower.z()) + (from.x() - lower.x()));
    }
  });
  return result;
}

DenseLevelSet trimmed(const DenseLevelSet& levelSet) {
  const DenseField& phi = levelSet.phi;
  const auto band = static_cast<float>(levelSet.band);
  Eigen::Vector3i lower = phi.size, upper = Eigen::Vector3i::Constant(-1);
  for (int k = 0; k < phi.size.z(); ++k)
    for (int j = 0; j < phi.size.y(); ++j) {
      const float *row = phi.row(j, k), *end = row + phi.size.x();
      const auto near = [band](float value) { return value < band; };
      const float* first = std::find_if(row, end, near);
      if (first == end) continue;
      const float* last = end;
      while (!near(*--last)) {
      }
      lower = lower.cwiseMin(Eigen::Vector3i(static_cast<int>(first - row), j, k));
      upper = upper.cwiseMax(Eigen::Vector3i(static_cast<int>(last - row), j, k));
    }
  if (upper.x() < 0) lower = upper = Eigen::Vector3i::Zero();
  return onBox(levelSet, lower - Eigen::Vector3i::Ones(), upper + Eigen::Vector3i::Ones());
}

}  // namespace sinew
