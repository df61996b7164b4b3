#include "TissuePlan.h"

#include "VolumeOffset.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr double kTwoLevelsDown = 0.25;

/// How large a tissue is, mm.
struct Extent {
  double largest;  ///< longest side of its box
  double mean;     ///< side of the cube of its volume
};

Extent extentOf(const ImageGeometry& geometry, const Tissue& tissue) {
  const Eigen::Vector3d sides =
      (tissue.box.upper - tissue.box.lower).cast<double>().cwiseProduct(geometry.spacing);
  return {sides.maxCoeff(), std::cbrt(static_cast<double>(tissue.voxels) * geometry.voxelVolume())};
}

/// A cube larger than the tissue stands for nothing. Who asks for cubes of two voxels or less, as by default,
/// wants to see specks too: they get three cubes along their mean extent, and may halve them.
double fittingEdge(const Extent& extent, double voxel, double wanted) {
  constexpr double kFineVoxels = 2 * (1 + 1e-9), kCubesAlong = 3;
  return std::min(wanted, wanted <= kFineVoxels * voxel ? extent.mean / kCubesAlong : extent.largest);
}

/// The mesher looks for the surface up to 1.55 edge lengths away, also where it is moved to keep the volume;
/// samples much finer than the lattice buy nothing, but a speck is sampled more finely than its voxels.
LevelSetFromLabelsOptions levelSetOptions(const ImageGeometry& geometry, double meanExtent, double edge,
                                          const MeshTissuesOptions& meshing) {
  constexpr double kSamplesPerEdge = 5, kSamplesAlong = 12, kFinestSpeck = 1.0 / 3;
  constexpr double kReachEdges = 1.56;  // with room for rounding
  const double bandEdges = kReachEdges + volumeRule(meshing.preserveVolume).largestEdges;
  const double voxel = defaultGridSpacing(geometry);
  LevelSetFromLabelsOptions options = meshing.levelSet;
  if (options.gridSpacing <= 0)
    options.gridSpacing =
        std::max({edge / kSamplesPerEdge, kFinestSpeck * voxel, std::min(voxel, meanExtent / kSamplesAlong)});
  options.bandVoxels = std::max(options.bandVoxels, bandEdges * edge / options.gridSpacing);
  return options;
}

/// The level set's samples are as fine as refinement goes at first, for a speck too; half voxels hold what is
/// thinner.
void planSmallestCubes(TissuePlan& plan, double voxel, double wanted) {
  if (wanted <= 0) {
    plan.sizes.smallest = plan.levelSet.gridSpacing;
    plan.thinnest = std::min(plan.sizes.smallest, std::max(0.5 * voxel, kTwoLevelsDown * plan.sizes.edge));
  } else {
    plan.thinnest = plan.sizes.smallest = plan.sizeReduced ? std::min(wanted, plan.sizes.edge / 2) : wanted;
  }
}

}  // namespace

TissuePlan planTissue(const Segmentation& segmentation, const Tissue& tissue, const TissueWish& wish,
                      const MeshTissuesOptions& options) {
  constexpr double kLargestOverEdge = 8;
  const double voxel = segmentation.geometry.meanSpacing();
  const Extent extent = extentOf(segmentation.geometry, tissue);
  const double maximum = options.maxEdgeLength.millimetres(voxel);
  const double largest = maximum > 0 ? maximum : kLargestOverEdge * wish.edge;
  TissuePlan plan;
  plan.sizes.edge = fittingEdge(extent, voxel, wish.edge);
  plan.sizes.largest = std::max(plan.sizes.edge, std::min(largest, extent.largest));
  plan.sizeReduced = plan.sizes.edge < wish.edge;
  plan.levelSet = levelSetOptions(segmentation.geometry, extent.mean, plan.sizes.edge, options);
  const bool smooth = wish.smoothing.kind != Smoothing::Kind::None;
  if (!smooth) plan.levelSet.smoothingVoxels = 0;
  plan.levelSet.preserveTopology = smooth;
  plan.motion = wish.smoothing.motion(voxel);
  planSmallestCubes(plan, voxel, options.minEdgeLength.millimetres(voxel));
  return plan;
}

TissuePlan planTrial(const Segmentation& segmentation, const Tissue& tissue, const TissueWish& wish,
                     const MeshTissuesOptions& options) {
  TissuePlan plan = planTissue(segmentation, tissue, wish, options);
  plan.thinnest = plan.sizes.smallest = std::max(plan.sizes.smallest, kTwoLevelsDown * plan.sizes.edge);
  return plan;
}

}  // namespace sinew
