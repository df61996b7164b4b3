#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// Convolves a mask with a Gauss: weights exp(-r^2 / (2 sigma^2)) for whole r up to 3.5 sigma, normalized,
/// one axis after the other. Beyond the raster lies the nearest sample.
/// @param sigmaVoxels  standard deviation along each axis, voxels; 0 leaves that axis alone
/// @return values in [0, 1]
/// @throws std::invalid_argument on a negative sigma.
/// Cost: O(voxels * sigma), in parallel; the same bits for any number of threads.
DenseField gaussianSmoothing(const DenseMask& mask, const Eigen::Vector3d& sigmaVoxels);

/// The same on a field, in place.
void gaussianSmoothing(DenseField& field, const Eigen::Vector3d& sigmaVoxels);

}  // namespace sinew
