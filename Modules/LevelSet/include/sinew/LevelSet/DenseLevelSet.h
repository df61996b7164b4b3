#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <Eigen/Geometry>

namespace sinew {

/// The signed distance of one tissue on an isotropic raster, phi < 0 inside: what levelSetFromField turns
/// into a grid of OpenVDB. Sample i lies at  x = frame * (voxelSize * i),  mm in LPS.
struct DenseLevelSet {
  DenseField phi;  ///< mm, as bandDistance gives it where |phi| < band, +-band beyond; > 0 on the border
  Eigen::Isometry3d frame =
      Eigen::Isometry3d::Identity();  ///< raster axes to LPS; a rotation and a translation
  double voxelSize = 1;               ///< mm
  double band = 3;                    ///< half width of the narrow band, mm
};

}  // namespace sinew
