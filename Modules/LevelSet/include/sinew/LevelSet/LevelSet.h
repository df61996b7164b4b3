#pragma once

#include <Eigen/Geometry>
#include <memory>

namespace sinew {

struct LevelSetGrid;  ///< holds the openvdb::FloatGrid; defined in sinew/LevelSet/LevelSetGrid.h

/// The signed distance of one tissue on an isotropic grid, phi < 0 inside.
///
/// Grid index i lies at  x = frame * (voxelSize * i),  mm in LPS; the values are stored at integer i in an OpenVDB
/// float grid, as bandDistance gives it where |phi| < band, +-band beyond.
struct LevelSet {
  std::shared_ptr<LevelSetGrid> grid;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();  ///< grid axes to LPS; a proper rotation and a translation
  double voxelSize = 1;                                     ///< mm
  double band = 3;                                          ///< half width of the narrow band, mm
  Eigen::Vector3i lower = Eigen::Vector3i::Zero();          ///< index box outside of which phi = +band, inclusive
  Eigen::Vector3i upper = Eigen::Vector3i::Zero();          ///< inclusive
};

}  // namespace sinew
