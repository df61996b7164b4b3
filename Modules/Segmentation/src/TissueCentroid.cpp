#include "sinew/Segmentation/TissueCentroid.h"

namespace sinew {

Eigen::Vector3d tissueCentroid(const Segmentation& segmentation, const Tissue& tissue) {
  const VoxelBox& box = tissue.box;
  Eigen::Matrix<std::int64_t, 3, 1> sum = Eigen::Matrix<std::int64_t, 3, 1>::Zero();
  std::int64_t count = 0;
  for (int k = box.lower.z(); k < box.upper.z(); ++k)
    for (int j = box.lower.y(); j < box.upper.y(); ++j)
      for (int i = box.lower.x(); i < box.upper.x(); ++i)
        if (segmentation.at(tissue.layer, {i, j, k}) == tissue.label) {
          sum += Eigen::Matrix<std::int64_t, 3, 1>(i, j, k);
          ++count;
        }
  return segmentation.geometry.indexToPhysical() * (sum.cast<double>() / static_cast<double>(count));
}

std::array<Eigen::Vector3d, 2> tissueBounds(const ImageGeometry& geometry, const Tissue& tissue) {
  const Eigen::Affine3d toPhysical = geometry.indexToPhysical();
  // Voxels reach half an index step beyond their centres.
  const Eigen::Vector3d lower = tissue.box.lower.cast<double>().array() - 0.5;
  const Eigen::Vector3d upper = tissue.box.upper.cast<double>().array() - 0.5;
  Eigen::AlignedBox3d bounds;
  for (int corner = 0; corner < 8; ++corner)
    bounds.extend(toPhysical * Eigen::Vector3d((corner & 1 ? upper : lower).x(),
                                               (corner & 2 ? upper : lower).y(),
                                               (corner & 4 ? upper : lower).z()));
  return {bounds.min(), bounds.max()};
}

}  // namespace sinew
