#pragma once

#include "sinew/LevelSet/DenseField.h"
#include "sinew/Segmentation/Segmentation.h"

#include <tbb/global_control.h>

namespace sinew::test {

/// f at the points  origin + spacing * i  of a raster.
template <typename Function>
DenseField sampled(const Eigen::Vector3i& size, const Eigen::Vector3d& origin, const Eigen::Vector3d& spacing,
                   const Function& f) {
  DenseField field(size);
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        field(i, j, k) =
            static_cast<float>(f(Eigen::Vector3d(origin + spacing.cwiseProduct(Eigen::Vector3d(i, j, k)))));
  return field;
}

/// Voxels (i,j,k) for which inside(i,j,k).
template <typename Predicate>
DenseMask maskOf(const Eigen::Vector3i& size, const Predicate& inside) {
  DenseMask mask(size);
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) mask(i, j, k) = inside(i, j, k) ? 1 : 0;
  return mask;
}

/// Label 1 where phi < 0 at the voxel centre (LPS mm), with its tissue table.
template <typename Function>
Segmentation segmentationOf(const ImageGeometry& geometry, const Function& phi) {
  Segmentation segmentation;
  segmentation.geometry = geometry;
  segmentation.layers.resize(1);
  const Eigen::Affine3d toPhysical = geometry.indexToPhysical();
  for (int k = 0; k < geometry.size.z(); ++k)
    for (int j = 0; j < geometry.size.y(); ++j)
      for (int i = 0; i < geometry.size.x(); ++i)
        segmentation.layers[0].push_back(phi(toPhysical * Eigen::Vector3d(i, j, k)) < 0 ? 1 : 0);
  updateTissueTable(segmentation);
  return segmentation;
}

/// An image of `size` whose middle is at the origin of LPS.
inline ImageGeometry centredGeometry(const Eigen::Vector3i& size, const Eigen::Vector3d& spacing,
                                     const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity()) {
  ImageGeometry geometry{size, spacing, Eigen::Vector3d::Zero(), direction};
  geometry.origin = -(direction * spacing.cwiseProduct((size - Eigen::Vector3i::Ones()).cast<double>()) / 2);
  return geometry;
}

/// The result of a function that runs on at most `threads` threads.
template <typename Function>
auto onThreads(int threads, const Function& run) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  return run();
}

}  // namespace sinew::test
