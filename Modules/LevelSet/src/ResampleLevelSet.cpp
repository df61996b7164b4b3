#include "sinew/LevelSet/ResampleLevelSet.h"

#include "LatticeBox.h"
#include "RigidScaling.h"
#include "sinew/LevelSet/FieldResampling.h"
#include "sinew/LevelSet/Redistance.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

/// Sample index of a level set to LPS mm.
Affine3d indexToPhysical(const DenseLevelSet& levelSet) {
  return levelSet.frame * Eigen::Scaling(levelSet.voxelSize);
}

/// Where its samples were moved to samples of the lattice: the first one there.
std::optional<Vector3i> firstMovedOn(const SampleLattice& lattice, const DenseLevelSet& levelSet,
                                     const Affine3d& motion) {
  if (motion.linear().determinant() < 0) return std::nullopt;
  DenseLevelSet corners;  // only the place of the samples counts
  corners.phi.size = levelSet.phi.size;
  corners.phi.values.resize(1);
  corners.frame = Eigen::Isometry3d((motion * levelSet.frame).matrix());
  corners.voxelSize = levelSet.voxelSize;
  return firstSampleOn(lattice, corners);
}

/// The samples put where they are on the lattice, within a new band.
DenseLevelSet placed(const DenseLevelSet& levelSet, const SampleLattice& lattice, const Vector3i& first,
                     double band) {
  DenseLevelSet result = emptyLevelSet(lattice, first, first, band);
  result.phi = levelSet.phi;
  if (band == levelSet.band) return result;
  const Vector3i margin =
      Vector3i::Constant(static_cast<int>(std::ceil(std::max(0.0, band - levelSet.band) / lattice.spacing)));
  result = onBox(result, -margin, levelSet.phi.size - Vector3i::Ones() + margin);
  redistance(result);
  return trimmed(result);
}

}  // namespace

DenseLevelSet resampled(const DenseLevelSet& levelSet, const SampleLattice& lattice, double band,
                        const Affine3d& motion) {
  constexpr double kUnscaled = 1e-9;
  const double scale = evenScale(motion, "resampled");
  if (!(band > 0))
    throw std::invalid_argument("resampled: band must be positive, got " + std::to_string(band));
  if (std::abs(scale - 1) < kUnscaled)
    if (const auto first = firstMovedOn(lattice, levelSet, motion))
      return placed(levelSet, lattice, *first, band);

  const Affine3d toLattice = lattice.frame.inverse() * motion * indexToPhysical(levelSet);
  const Eigen::AlignedBox3d samples(Vector3d::Zero(), (levelSet.phi.size - Vector3i::Ones()).cast<double>());
  const LatticeBox box = latticeBox(samples.transformed(toLattice), lattice.spacing,
                                    std::max(0.0, band - scale * levelSet.band), "resampled");
  DenseLevelSet result = emptyLevelSet(lattice, box.lower, box.upper, band);
  const Affine3d toField = indexToPhysical(levelSet).inverse() * motion.inverse() * indexToPhysical(result);
  result.phi = resampleAffine(levelSet.phi, toField, result.phi.size);
  redistance(result);  // only the zero set counts: values need no scaling
  return trimmed(result);
}

}  // namespace sinew
