#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <Eigen/Geometry>

namespace sinew {

/// Samples a field along one axis at index  first + step * i,  i = 0 .. count-1, with Catmull-Rom; beyond the
/// raster lies the nearest sample. Cost: O(result), in parallel.
DenseField resampleAxis(const DenseField& field, int axis, double first, double step, int count);

/// Samples a field at index  toField * i  for every i of a raster of `size`, with tricubic Catmull-Rom;
/// beyond the field lies the nearest sample. Cost: O(result): 64 samples each where the field varies, 8 where
/// it is constant; in parallel.
DenseField resampleAffine(const DenseField& field, const Eigen::Affine3d& toField,
                          const Eigen::Vector3i& size);

}  // namespace sinew
