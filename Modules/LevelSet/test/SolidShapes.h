#pragma once

#include "sinew/LevelSet/FieldVolume.h"
#include "sinew/LevelSet/Solid.h"

#include <limits>
#include <random>

namespace sinew::test {

/// A lattice whose axes are turned against those of LPS, and whose samples lie at no round numbers.
inline SampleLattice tiltedLattice(double spacing = 1) {
  SampleLattice lattice;
  lattice.frame = Eigen::Translation3d(0.31, -0.17, 0.43) *
                  Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized());
  lattice.spacing = spacing;
  return lattice;
}

inline const Eigen::AlignedBox3d kEverywhere{
    Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
    Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};

inline DenseLevelSet sampled(const Solid& solid, double band = 4,
                             const SampleLattice& lattice = tiltedLattice()) {
  return sampleSolid(solid, lattice, band, kEverywhere);
}

inline double volumeOf(const DenseLevelSet& levelSet) {
  return fieldVolume(levelSet.phi, Eigen::Vector3d::Constant(levelSet.voxelSize));
}

/// Calls check(x, phi), x in LPS mm.
template <class Check>
void forEachSample(const DenseLevelSet& levelSet, const Check& check) {
  const DenseField& phi = levelSet.phi;
  for (int k = 0; k < phi.size.z(); ++k)
    for (int j = 0; j < phi.size.y(); ++j)
      for (int i = 0; i < phi.size.x(); ++i)
        check(levelSet.frame * (levelSet.voxelSize * Eigen::Vector3d(i, j, k)), phi(i, j, k));
}

/// Calls check(x) where phi crosses zero between two neighbours, linearly.
template <class Check>
void forEachCrossing(const DenseLevelSet& levelSet, const Check& check) {
  const DenseField& phi = levelSet.phi;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3i step = Eigen::Vector3i::Unit(axis);
    for (int k = 0; k < phi.size.z() - step.z(); ++k)
      for (int j = 0; j < phi.size.y() - step.y(); ++j)
        for (int i = 0; i < phi.size.x() - step.x(); ++i) {
          const double here = phi(i, j, k), there = phi(i + step.x(), j + step.y(), k + step.z());
          if ((here < 0) == (there < 0)) continue;
          const Eigen::Vector3d index =
              Eigen::Vector3d(i, j, k) + here / (here - there) * step.cast<double>();
          check(levelSet.frame * (levelSet.voxelSize * index));
        }
  }
}

inline Eigen::Vector3d pointIn(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

}  // namespace sinew::test
