#include "sinew/LevelSet/LevelSetFromTriangles.h"

#include "ClosedSurfaces.h"
#include "sinew/LevelSet/LevelSetGrid.h"
#include "sinew/LevelSet/LevelSetMeasures.h"

#include <openvdb/tools/Composite.h>
#include <openvdb/tools/MeshToVolume.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using openvdb::FloatGrid;

void checkOptions(const LevelSetFromTrianglesOptions& options) {
  if (!(options.spacing >= 0) || !std::isfinite(options.spacing))
    throw std::invalid_argument("levelSetFromTriangles: spacing must not be negative, got " +
                                std::to_string(options.spacing));
  if (!(options.bandVoxels >= 3 && options.bandVoxels <= 100))
    throw std::invalid_argument("levelSetFromTriangles: bandVoxels must lie in [3, 100], got " +
                                std::to_string(options.bandVoxels));
}

Eigen::AlignedBox3d boxOf(const TriangleSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : surface.triangles)
    for (const std::int32_t node : triangle) box.extend(surface.nodes[node]);
  return box;
}

/// One closed surface as OpenVDB reads it, in voxels.
class Polygons {
 public:
  Polygons(const TriangleSurface& surface, const ClosedSurface& part, const Eigen::Vector3d& origin,
           double voxelSize)
      : surface_(surface), part_(part), origin_(origin), voxelSize_(voxelSize) {}

  std::size_t polygonCount() const { return part_.triangles.size(); }
  std::size_t pointCount() const { return surface_.nodes.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t corner, openvdb::Vec3d& at) const {
    const Eigen::Vector3d& node = surface_.nodes[surface_.triangles[part_.triangles[polygon]][corner]];
    const Eigen::Vector3d index = (node - origin_) / voxelSize_;
    at = {index.x(), index.y(), index.z()};
  }

 private:
  const TriangleSurface& surface_;
  const ClosedSurface& part_;
  Eigen::Vector3d origin_;
  double voxelSize_;
};

/// Where the grid lies; @throws when the spacing would make it enormous.
void placeGrid(const TriangleSurface& surface, const LevelSetFromTrianglesOptions& options,
               LevelSet& result) {
  constexpr double kVoxelsAlong = 200, kMostVoxelsAlong = 1e5;
  const Eigen::AlignedBox3d box = boxOf(surface);
  const double side = box.sizes().maxCoeff();
  result.voxelSize = options.spacing > 0 ? options.spacing : side / kVoxelsAlong;
  if (side > kMostVoxelsAlong * result.voxelSize)
    throw std::invalid_argument("levelSetFromTriangles: a spacing of " + std::to_string(result.voxelSize) +
                                " mm is too fine for a surface of " + std::to_string(side) + " mm");
  result.band = options.bandVoxels * result.voxelSize;
  result.frame.translation() = box.min();
}

openvdb::CoordBBox activeBox(const FloatGrid& grid) {
  openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) throw std::invalid_argument("levelSetFromTriangles: the surface has no volume");
  box.expand(1);
  return box;
}

}  // namespace

LevelSet levelSetFromTriangles(const TriangleSurface& surface, const LevelSetFromTrianglesOptions& options,
                               LevelSetFromTrianglesReport* report) {
  checkOptions(options);
  const std::vector<ClosedSurface> parts = closedSurfaces(surface);
  double volume = 0;
  for (const ClosedSurface& part : parts) volume += part.volume;

  openvdb::initialize();
  LevelSet result;
  placeGrid(surface, options, result);
  const Eigen::Vector3d origin = result.frame.translation();
  const auto transform = openvdb::math::Transform::createLinearTransform(result.voxelSize);
  transform->postTranslate({origin.x(), origin.y(), origin.z()});

  const auto distanceTo = [&](const ClosedSurface& part) {
    const auto band = static_cast<float>(options.bandVoxels);
    return openvdb::tools::meshToVolume<FloatGrid>(Polygons(surface, part, origin, result.voxelSize),
                                                   *transform, band, band);
  };
  LevelSetFromTrianglesReport made;
  const auto grid = FloatGrid::create(static_cast<float>(result.band));
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  const auto isSolid = [&](const ClosedSurface& part) { return part.volume * volume > 0; };
  for (const ClosedSurface& part : parts) {
    if (!isSolid(part)) continue;
    openvdb::tools::csgUnion(*grid, *distanceTo(part));
    ++made.solids;
  }
  for (const ClosedSurface& part : parts) {
    if (isSolid(part)) continue;
    openvdb::tools::csgDifference(*grid, *distanceTo(part));
    ++made.cavities;
  }
  const openvdb::CoordBBox active = activeBox(*grid);
  result.lower = {active.min().x(), active.min().y(), active.min().z()};
  result.upper = {active.max().x(), active.max().y(), active.max().z()};
  result.grid = std::make_shared<LevelSetGrid>(LevelSetGrid{grid});
  if (report != nullptr) {
    made.surfaceVolume = std::abs(volume);
    made.levelSetVolume = levelSetVolume(result);
    *report = made;
  }
  return result;
}

}  // namespace sinew
