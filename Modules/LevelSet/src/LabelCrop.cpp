#include "sinew/LevelSet/LabelCrop.h"

#include <tbb/parallel_for.h>

#include <algorithm>
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

RasterAxes rasterAxes(const ImageGeometry& geometry, int lastAxis) {
  RasterAxes axes;
  axes.order = {(lastAxis == 0) ? 1 : 0, (lastAxis == 2) ? 1 : 2, lastAxis};
  for (int a = 0; a < 3; ++a) axes.directions.col(a) = geometry.direction.col(axes.order[a]);
  axes.lastReversed = axes.directions.determinant() < 0;
  if (axes.lastReversed) axes.directions.col(2) *= -1;
  return axes;
}

LabelCrop cropLabel(const Segmentation& segmentation, const Tissue& tissue, const Eigen::Vector3i& margin,
                    int lastAxis, const Eigen::Vector3i& block) {
  checkTissue(segmentation, tissue);
  if ((block.array() < 1).any()) throw std::invalid_argument("cropLabel: a cell has at least one voxel");
  const ImageGeometry& geometry = segmentation.geometry;
  const RasterAxes axes = rasterAxes(geometry, lastAxis);
  const Eigen::Vector3i& axis = axes.order;

  LabelCrop crop;
  Eigen::Matrix3d edges;  // one voxel step along each axis, mm
  Eigen::Vector3i first, step = Eigen::Vector3i::Ones(), extent, pad;
  for (int a = 0; a < 3; ++a) {
    edges.col(a) = axes.directions.col(a) * geometry.spacing[axis[a]];
    first[a] = tissue.box.lower[axis[a]];
    extent[a] = tissue.box.upper[axis[a]] - first[a];
    pad[a] = margin[axis[a]];
    crop.block[a] = block[axis[a]];
  }
  if (axes.lastReversed) {
    first[2] += extent[2] - 1;
    step[2] = -1;
  }

  const Eigen::Vector3i& cell = crop.block;
  const Eigen::Vector3i cells = (extent + cell - Eigen::Vector3i::Ones()).cwiseQuotient(cell);
  crop.coverage = DenseField(cells + 2 * pad);
  const std::int64_t stride[3] = {1, geometry.size.x(), std::int64_t{geometry.size.x()} * geometry.size.y()};
  const std::int32_t* labels = segmentation.layers[static_cast<std::size_t>(tissue.layer)].data();
  const float voxelPart = 1 / static_cast<float>(cell.prod());
  tbb::parallel_for(0, cells.z(), [&](int slab) {
    for (int k = slab * cell.z(); k < std::min((slab + 1) * cell.z(), extent.z()); ++k)
      for (int j = 0; j < extent.y(); ++j) {
        const std::int32_t* in = labels + first[0] * stride[axis[0]] + (first[1] + j) * stride[axis[1]] +
                                 (first[2] + step[2] * k) * stride[axis[2]];
        float* out = crop.coverage.row(j / cell.y() + pad.y(), slab + pad.z()) + pad.x();
        for (int i = 0; i < extent.x(); ++out)
          for (const int end = std::min(i + cell.x(), extent.x()); i < end; ++i)
            if (in[i * stride[axis[0]]] == tissue.label) *out += voxelPart;
      }
  });

  Eigen::Vector3d corner = geometry.origin;  // centre of the first cell
  for (int a = 0; a < 3; ++a) {
    crop.spacing[a] = geometry.spacing[axis[a]] * cell[a];
    corner += geometry.direction.col(axis[a]) * (geometry.spacing[axis[a]] * first[a]);
    corner += edges.col(a) * (0.5 * (cell[a] - 1) - pad[a] * cell[a]);
    edges.col(a) *= cell[a];
  }
  crop.indexToPhysical.linear() = edges;
  crop.indexToPhysical.translation() = corner;
  return crop;
}

DenseMask mostlyCovered(const DenseField& coverage) {
  DenseMask mask(coverage.size);
  std::transform(coverage.values.begin(), coverage.values.end(), mask.values.begin(),
                 [](float part) { return static_cast<std::uint8_t>(part >= 0.5F); });
  return mask;
}

}  // namespace sinew
