#include "sinew/LevelSet/LevelSetFromTriangles.h"

#include "ClosedSurfaces.h"
#include "GridTransform.h"
#include "LatticeBox.h"
#include "MarchOn.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetGrid.h"
#include "sinew/LevelSet/LevelSetMeasures.h"

#include <openvdb/tools/Composite.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace sinew {
namespace {

using openvdb::FloatGrid;

constexpr double kLeastBandVoxels = 3, kMostBandVoxels = 100;
constexpr double kExactVoxels = 1.5;  ///< from the surface to where OpenVDB finds the closest triangle

void checkOptions(const LevelSetFromTrianglesOptions& options) {
  if (!(options.spacing >= 0) || !std::isfinite(options.spacing))
    throw std::invalid_argument("levelSetFromTriangles: spacing must not be negative, got " +
                                std::to_string(options.spacing));
  if (!(options.bandVoxels >= kLeastBandVoxels && options.bandVoxels <= kMostBandVoxels))
    throw std::invalid_argument("levelSetFromTriangles: bandVoxels must lie in [3, 100], got " +
                                std::to_string(options.bandVoxels));
}

Eigen::AlignedBox3d boxOf(const TriangleSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : surface.triangles)
    for (const std::int32_t node : triangle) box.extend(surface.nodes[node]);
  return box;
}

/// The nodes by the indices of a lattice. In single precision OpenVDB's library holds the conversion ready made:
/// at 200 voxels from the origin that is a 60,000th of a voxel.
std::vector<openvdb::Vec3s> indexPoints(const TriangleSurface& surface, const SampleLattice& lattice) {
  const Eigen::Affine3d toIndex = Eigen::Scaling(1 / lattice.spacing) * lattice.frame.inverse();
  std::vector<openvdb::Vec3s> points;
  points.reserve(surface.nodes.size());
  for (const Eigen::Vector3d& node : surface.nodes) {
    const Eigen::Vector3f index = (toIndex * node).cast<float>();
    points.emplace_back(index.x(), index.y(), index.z());
  }
  return points;
}

/// The corners of one closed surface's triangles.
std::vector<openvdb::Vec3I> corners(const TriangleSurface& surface, const ClosedSurface& part) {
  std::vector<openvdb::Vec3I> result;
  result.reserve(part.triangles.size());
  for (const auto t : part.triangles) {
    const auto& [a, b, c] = surface.triangles[t];
    result.emplace_back(a, b, c);
  }
  return result;
}

/// A lattice along the axes of LPS; @throws when the spacing would make it enormous.
SampleLattice latticeFor(const TriangleSurface& surface, const LevelSetFromTrianglesOptions& options) {
  constexpr double kVoxelsAlong = 200, kMostVoxelsAlong = 1e5;
  const Eigen::AlignedBox3d box = boxOf(surface);
  const double side = box.sizes().maxCoeff();
  SampleLattice lattice;
  lattice.spacing = options.spacing > 0 ? options.spacing : side / kVoxelsAlong;
  if (side > kMostVoxelsAlong * lattice.spacing)
    throw std::invalid_argument("levelSetFromTriangles: a spacing of " + std::to_string(lattice.spacing) +
                                " mm is too fine for a surface of " + std::to_string(side) + " mm");
  lattice.frame.translation() = box.min();
  return lattice;
}

openvdb::CoordBBox activeBox(const FloatGrid& grid) {
  openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) throw std::invalid_argument("levelSetFromTriangles: the surface has no volume");
  box.expand(1);
  return box;
}

/// What encloses more comes first, so that a solid in a cavity in a solid is there at the end.
std::vector<ClosedSurface> largestFirst(std::vector<ClosedSurface> parts) {
  std::ranges::stable_sort(parts, std::ranges::greater(),
                           [](const ClosedSurface& part) { return std::abs(part.volume); });
  return parts;
}

LevelSet levelSetOn(const SampleLattice& lattice, const TriangleSurface& surface,
                    const std::vector<ClosedSurface>& parts, double bandVoxels,
                    LevelSetFromTrianglesReport* report) {
  openvdb::initialize();
  double volume = 0;
  for (const ClosedSurface& part : parts) volume += part.volume;

  LevelSet result;
  result.frame = lattice.frame;
  result.voxelSize = lattice.spacing;
  result.band = bandVoxels * lattice.spacing;
  const auto transform = gridTransform(lattice.frame, lattice.spacing);
  const auto grid = FloatGrid::create(static_cast<float>(result.band));
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);

  LevelSetFromTrianglesReport made;
  const std::vector<openvdb::Vec3s> points = indexPoints(surface, lattice);
  openvdb::util::NullInterrupter uninterrupted;
  for (const ClosedSurface& part : largestFirst(parts)) {
    const auto band = static_cast<float>(bandVoxels);
    const std::vector<openvdb::Vec3I> triangles = corners(surface, part);
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> polygons(points,
                                                                                              triangles);
    const auto distance =
        openvdb::tools::meshToVolume<FloatGrid>(uninterrupted, polygons, *transform, band, band);
    if (part.volume * volume > 0) {
      openvdb::tools::csgUnion(*grid, *distance);
      ++made.solids;
    } else {
      openvdb::tools::csgDifference(*grid, *distance);
      ++made.cavities;
    }
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

}  // namespace

LevelSet levelSetFromTriangles(const TriangleSurface& surface, const LevelSetFromTrianglesOptions& options,
                               LevelSetFromTrianglesReport* report) {
  checkOptions(options);
  const std::vector<ClosedSurface> parts = closedSurfaces(surface);
  return levelSetOn(latticeFor(surface, options), surface, parts, options.bandVoxels, report);
}

DenseLevelSet levelSetFromTriangles(const TriangleSurface& surface, const SampleLattice& lattice, double band,
                                    LevelSetFromTrianglesReport* report) {
  const double bandVoxels = band / lattice.spacing;
  if (!(band > 0) || !(bandVoxels <= kMostBandVoxels))
    throw std::invalid_argument("levelSetFromTriangles: band must be positive and at most " +
                                std::to_string(kMostBandVoxels * lattice.spacing) + " mm, got " +
                                std::to_string(band));
  const std::vector<ClosedSurface> parts = closedSurfaces(surface);
  latticeBox(boxOf(surface).transformed(lattice.frame.inverse()), lattice.spacing, band,
             "levelSetFromTriangles");  // fails where it is too large
  DenseLevelSet result =
      fieldFromLevelSet(levelSetOn(lattice, surface, parts, std::max(bandVoxels, kLeastBandVoxels), report));
  marchOn(result.phi, lattice.spacing, std::min(band, kExactVoxels * lattice.spacing), band);
  result.band = band;
  return result;
}

}  // namespace sinew
