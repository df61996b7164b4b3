#include "sinew/LevelSet/LabelCrop.h"

#include <stdexcept>
#include <string>

namespace sinew {
namespace {

void checkTissue(const Segmentation& segmentation, const Tissue& tissue) {
  const std::string who = "cropLabel: tissue '" + tissue.name + "' ";
  if (tissue.voxels <= 0 || tissue.box.empty()) throw std::invalid_argument(who + "has no voxels");
  if (tissue.layer < 0 || tissue.layer >= static_cast<int>(segmentation.layers.size()))
    throw std::invalid_argument(who + "is on layer " + std::to_string(tissue.layer) + " of " +
                                std::to_string(segmentation.layers.size()));
  if ((tissue.box.lower.array() < 0).any() ||
      (tissue.box.upper.array() > segmentation.geometry.size.array()).any())
    throw std::invalid_argument(who + "has a box that leaves the image");
}

}  // namespace

LabelCrop cropLabel(const Segmentation& segmentation, const Tissue& tissue, const Eigen::Vector3i& margin,
                    int lastAxis) {
  checkTissue(segmentation, tissue);
  const ImageGeometry& geometry = segmentation.geometry;
  const Eigen::Vector3i axis((lastAxis == 0) ? 1 : 0, (lastAxis == 2) ? 1 : 2, lastAxis);

  Eigen::Matrix3d edges;  // one raster step along each axis, mm
  Eigen::Vector3i first, step = Eigen::Vector3i::Ones(), extent, pad;
  for (int a = 0; a < 3; ++a) {
    edges.col(a) = geometry.direction.col(axis[a]) * geometry.spacing[axis[a]];
    first[a] = tissue.box.lower[axis[a]];
    extent[a] = tissue.box.upper[axis[a]] - first[a];
    pad[a] = margin[axis[a]];
  }
  if (edges.determinant() < 0) {
    edges.col(2) *= -1;
    first[2] += extent[2] - 1;
    step[2] = -1;
  }

  LabelCrop crop;
  crop.mask = DenseMask(extent + 2 * pad);
  const std::int64_t stride[3] = {1, geometry.size.x(), std::int64_t{geometry.size.x()} * geometry.size.y()};
  const std::int32_t* labels = segmentation.layers[static_cast<std::size_t>(tissue.layer)].data();
  for (int k = 0; k < extent.z(); ++k)
    for (int j = 0; j < extent.y(); ++j) {
      const std::int32_t* in = labels + first[0] * stride[axis[0]] + (first[1] + j) * stride[axis[1]] +
                               (first[2] + step[2] * k) * stride[axis[2]];
      std::uint8_t* out = crop.mask.row(j + pad.y(), k + pad.z()) + pad.x();
      for (int i = 0; i < extent.x(); ++i) out[i] = in[i * stride[axis[0]]] == tissue.label;
    }

  Eigen::Vector3d corner = geometry.origin;
  for (int a = 0; a < 3; ++a) {
    crop.spacing[a] = geometry.spacing[axis[a]];
    corner += geometry.direction.col(axis[a]) * (geometry.spacing[axis[a]] * first[a]);
    corner -= edges.col(a) * pad[a];
  }
  crop.indexToPhysical.linear() = edges;
  crop.indexToPhysical.translation() = corner;
  return crop;
}

}  // namespace sinew
