#include "TissueCost.h"

#include "sinew/Mesher/GenerateTetMesh.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

// A staircase has 1.5 times the area of the smooth surface behind it, over all directions.
constexpr double kStaircaseArea = 1.5;
// As estimateMemory of the mesher has it: so many tets per cube face of smooth surface, and per cube inside.
constexpr double kBytesPerSurfaceCube = 60 * kBytesPerTet;
constexpr double kBytesPerInnerCube = 12 * kBytesPerTet;
constexpr double kBytesPerVoxel = 12;      // of the crop and of the level set's grid: masks and fields
constexpr double kBytesPerBandVoxel = 20;  // grid, bricks, march
constexpr double kWorkPerVoxel = 0.005;    // of the work of one surface cube

/// Area of the faces between the tissue and all else, mm^2.
double staircaseArea(const Segmentation& segmentation, const Tissue& tissue) {
  const Eigen::Vector3d& spacing = segmentation.geometry.spacing;
  const std::vector<std::int32_t>& voxels = segmentation.layers[tissue.layer];
  const Eigen::Vector3i& size = segmentation.geometry.size;
  const std::array<std::ptrdiff_t, 3> stride{1, size.x(), static_cast<std::ptrdiff_t>(size.x()) * size.y()};
  std::array<std::int64_t, 3> faces{};
  for (int z = tissue.box.lower.z(); z < tissue.box.upper.z(); ++z)
    for (int y = tissue.box.lower.y(); y < tissue.box.upper.y(); ++y)
      for (int x = tissue.box.lower.x(); x < tissue.box.upper.x(); ++x) {
        const std::array<int, 3> index{x, y, z};
        const std::int32_t* voxel = voxels.data() + x * stride[0] + y * stride[1] + z * stride[2];
        if (*voxel != tissue.label) continue;
        for (int axis = 0; axis < 3; ++axis) {
          faces[axis] += index[axis] == 0 || voxel[-stride[axis]] != tissue.label;
          faces[axis] += index[axis] + 1 == size[axis] || voxel[stride[axis]] != tissue.label;
        }
      }
  double area = 0;
  for (int axis = 0; axis < 3; ++axis)
    area += static_cast<double>(faces[axis]) * spacing[(axis + 1) % 3] * spacing[(axis + 2) % 3];
  return area;
}

}  // namespace

double surfaceArea(const Segmentation& segmentation, const Tissue& tissue) {
  return staircaseArea(segmentation, tissue) / kStaircaseArea;
}

TissueCost estimateCost(const Segmentation& segmentation, const Tissue& tissue, const TissueSizes& sizes,
                        const LevelSetFromLabelsOptions& levelSet) {
  const ImageGeometry& geometry = segmentation.geometry;
  const double area = surfaceArea(segmentation, tissue);
  const double volume = static_cast<double>(tissue.voxels) * geometry.voxelVolume();
  const double spacing = levelSet.gridSpacing, band = levelSet.bandVoxels * spacing;
  const Eigen::Array3d sides =
      (tissue.box.upper - tissue.box.lower).cast<double>().cwiseProduct(geometry.spacing).array();
  const double gridVoxels = (sides + 2 * band).prod() / std::pow(spacing, 3);
  const double cropVoxels = sides.prod() / geometry.voxelVolume();
  const double bandVoxels = std::min(gridVoxels, 2 * band * area / std::pow(spacing, 3));
  const double surfaceCubes = area / (sizes.edge * sizes.edge);
  const double innerCubes = volume / std::pow(sizes.largest, 3);
  TissueCost cost;
  cost.work = surfaceCubes + innerCubes + kWorkPerVoxel * (cropVoxels + gridVoxels);
  cost.ofVoxels = kBytesPerVoxel * (cropVoxels + gridVoxels) + kBytesPerBandVoxel * bandVoxels;
  cost.memory = kBytesPerSurfaceCube * surfaceCubes + kBytesPerInnerCube * innerCubes + cost.ofVoxels;
  return cost;
}

}  // namespace sinew
