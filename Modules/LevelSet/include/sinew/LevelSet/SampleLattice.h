#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/Segmentation/ImageGeometry.h"

#include <optional>

namespace sinew {

/// The isotropic lattice of samples that the level sets of one scan share, so that CSG between them needs no
/// resampling: sample i lies at  x = frame * (spacing * i),  LPS mm, i any whole numbers.
struct SampleLattice {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< a rotation and a translation
  double spacing = 1;                                       ///< mm
};

/// The lattice on which levelSetFromLabels with `onCommonLattice` puts every tissue of an image: axes are the
/// rotation nearest to the image's (after its order and direction), one sample lies on voxel (0,0,0).
/// @param spacing  mm; 0: defaultGridSpacing
SampleLattice commonLattice(const ImageGeometry& geometry, double spacing = 0);

/// Where the first sample of a level set lies on a lattice; nothing when its samples are not the lattice's
/// (another spacing, other axes, or more than a thousandth of the spacing between).
std::optional<Eigen::Vector3i> firstSampleOn(const SampleLattice& lattice, const DenseLevelSet& levelSet);

/// An empty piece of a lattice: phi = +band everywhere.
/// @param lower,upper  first and last sample, inclusive
DenseLevelSet emptyLevelSet(const SampleLattice& lattice, const Eigen::Vector3i& lower,
                            const Eigen::Vector3i& upper, double band);

/// The same shape on another box of the same lattice; samples that it had not get +band, what the box leaves
/// out is lost. `lower`, `upper` count from the level set's first sample, inclusive.
DenseLevelSet onBox(const DenseLevelSet& levelSet, const Eigen::Vector3i& lower, const Eigen::Vector3i& upper);

/// The same shape on the smallest box that holds every sample below +band, and one layer of +band around.
DenseLevelSet trimmed(const DenseLevelSet& levelSet);

}  // namespace sinew
