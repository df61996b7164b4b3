#include "sinew/LevelSet/LevelSetFromLabels.h"

#include "GridPlan.h"
#include "SimplePoint.h"
#include "sinew/LevelSet/BandDistance.h"
#include "sinew/LevelSet/FieldResampling.h"
#include "sinew/LevelSet/FieldVolume.h"
#include "sinew/LevelSet/GaussianSmoothing.h"
#include "sinew/LevelSet/LabelCrop.h"
#include "sinew/LevelSet/SliceDistances.h"
#include "sinew/LevelSet/SliceInterpolation.h"
#include "sinew/LevelSet/SliceSmoothing.h"
#include "sinew/LevelSet/SmallPieces.h"
#include "sinew/LevelSet/SurfaceLevel.h"
#include "sinew/LevelSet/VolumeKeepingIso.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

/// Slices: distances are kept up to this many slice spacings, so that slopes down to 1:16 become ramps.
constexpr double kSlopeSlices = 16;
/// A tissue that vanishes is smoothed less and less; below this many voxels not at all.
constexpr double kLeastSmoothing = 0.3;

void checkOptions(const LevelSetFromLabelsOptions& options) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds)
      throw std::invalid_argument("levelSetFromLabels: " + std::string(what) + ", got " +
                                  std::to_string(value));
  };
  require(options.smoothingVoxels >= 0 && options.smoothingVoxels <= 20,
          "smoothingVoxels must lie in [0, 20]", options.smoothingVoxels);
  require(options.bandVoxels >= 3 && options.bandVoxels <= 100, "bandVoxels must lie in [3, 100]",
          options.bandVoxels);
  require(options.thickSliceRatio >= 1, "thickSliceRatio must be at least 1", options.thickSliceRatio);
  require(options.gridSpacing >= 0 && std::isfinite(options.gridSpacing), "gridSpacing must not be negative",
          options.gridSpacing);
}

/// A field whose zero set is the tissue's surface, on the raster of a crop.
struct SurfaceField {
  DenseField values;  ///< negative inside
  double iso = 0.5;
};

/// @param cells  the tissue's volume
SurfaceField smoothedField(DenseField coverage, double cells, const Eigen::Vector3d& sigma) {
  SurfaceField field{std::move(coverage), 0.5};
  if (sigma.isZero()) {
    for (float& v : field.values.values) v = 0.5F - v;
    return field;
  }
  const DenseMask mask = mostlyCovered(field.values);
  gaussianSmoothing(field.values, sigma);
  field.iso = volumeKeepingIso(field.values, cells);
  subtractSurfaceLevel(field.values, mask, sigma, field.iso);
  const double notSmoothed = field.iso - 1;
  restoreSmallPieces(field.values, mask, static_cast<float>(notSmoothed));
  return field;
}

/// Spacing that is equal enough to be taken for the grid's own: less than a hundredth of a voxel over the
/// raster.
bool sameSpacing(double spacing, double h, int samples) { return std::abs(spacing / h - 1) * samples < 0.01; }

void resampleTo(DenseField& field, int axis, double spacing, double h, double first, int count) {
  if (sameSpacing(spacing, h, count) && first == 0 && field.size[axis] == count) return;
  field = resampleAxis(field, axis, first / spacing, h / spacing, count);
}

/// Heights of the grid's planes in slices; those beyond the first and last slice repeat it.
std::vector<double> planes(double spacing, double h, double first, int count, int slices) {
  std::vector<double> positions;
  for (int i = 0; i < count; ++i)
    positions.push_back(std::clamp((first + i * h) / spacing, 0.0, slices - 1.0));
  return positions;
}

/// The field on the grid of the level set.
DenseField fieldOnGrid(DenseField field, const LabelCrop& crop, const GridPlacement& place,
                       const GridPlan& plan) {
  const Eigen::Vector3d& spacing = crop.spacing;
  if (plan.thick) {
    sliceDistances(field, spacing.head<2>(), kSlopeSlices * spacing.z());
    smoothAcrossSlices(field, spacing.head<2>().minCoeff());
  }
  if (place.aligned) {
    for (int a = 0; a < (plan.thick ? 2 : 3); ++a)
      resampleTo(field, a, spacing[a], plan.h, place.first[a], place.size[a]);
    if (!plan.thick) return field;
    const std::vector<double> heights =
        planes(spacing.z(), plan.h, place.first.z(), place.size.z(), field.size.z());
    return interpolateSlices(field, spacing.z(), heights, plan.reach);
  }
  Eigen::Vector3d fieldStep = Eigen::Vector3d::Ones();  // raster index per index of `field`
  if (plan.thick) {
    const int slices = field.size.z(),
              count = static_cast<int>(std::floor((slices - 1) * spacing.z() / plan.h)) + 1;
    field = interpolateSlices(field, spacing.z(), planes(spacing.z(), plan.h, 0, count, slices), plan.reach);
    fieldStep.z() = plan.h / spacing.z();
  }
  const Eigen::Affine3d toField = Eigen::Affine3d(Eigen::Scaling(Eigen::Vector3d(fieldStep.cwiseInverse()))) *
                                  crop.indexToPhysical.inverse() * place.frame * Eigen::Scaling(plan.h);
  return resampleAffine(field, toField, place.size);
}

bool hasInside(const DenseField& field) {
  return std::any_of(field.values.begin(), field.values.end(), [](float v) { return v < 0; });
}

/// The last resort for a tissue that falls between the samples: the samples nearest to its voxels are inside.
void stampVoxels(DenseField& field, const LabelCrop& crop, const GridPlacement& place, double h) {
  const Eigen::Affine3d toGrid = Eigen::Scaling(1 / h) * place.frame.inverse() * crop.indexToPhysical;
  const float inside = -*std::max_element(field.values.begin(), field.values.end());
  for (int k = 0; k < crop.coverage.size.z(); ++k)
    for (int j = 0; j < crop.coverage.size.y(); ++j)
      for (int i = 0; i < crop.coverage.size.x(); ++i) {
        if (crop.coverage(i, j, k) == 0) continue;
        const Eigen::Vector3i at = (toGrid * Eigen::Vector3d(i, j, k)).array().round().cast<int>();
        field(at.x(), at.y(), at.z()) = inside;
      }
}

/// A field on the grid of the level set whose zero set is the tissue's surface.
struct TissueField {
  DenseField phi;  ///< negative inside, not yet a distance
  Eigen::Isometry3d frame;
  double iso;
};

/// A tissue that smoothing would wipe out is smoothed less and less.
TissueField tissueField(const Segmentation& segmentation, const Tissue& tissue, const GridPlan& plan,
                        double smoothing) {
  LabelCrop crop = cropLabel(segmentation, tissue, plan.margin, plan.lastAxis, plan.block);
  const GridPlacement place = placeGrid(crop, plan);
  const double cells = static_cast<double>(tissue.voxels) / plan.block.prod();
  Eigen::Vector3d sigma;
  for (int a = 0; a < 3; ++a)
    sigma[a] = plan.thick && a == 2 ? 0 : sigmaAlong(smoothing, crop.spacing[a], crop.block[a], plan.h);
  SurfaceField field = smoothedField(std::move(crop.coverage), cells, sigma);
  TissueField result{fieldOnGrid(std::move(field.values), crop, place, plan), place.frame, field.iso};
  if (hasInside(result.phi)) return result;
  if (smoothing > 0)
    return tissueField(segmentation, tissue, plan, smoothing > kLeastSmoothing ? smoothing / 2 : 0);
  stampVoxels(result.phi, cropLabel(segmentation, tissue, plan.margin, plan.lastAxis, plan.block), place,
              plan.h);
  return result;
}

/// The offset that gives a signed distance the wanted volume; it never takes more than half of the depth.
double volumeOffset(const DenseField& phi, const Eigen::Vector3d& spacing, double volume, double largest) {
  const double depth = -*std::min_element(phi.values.begin(), phi.values.end());
  return volumeKeepingLevel(phi, spacing, volume, -std::min(largest, depth / 2), largest);
}

/// Moves the zero set outward by `offset`, and narrows the band.
void moveSurface(DenseField& phi, float offset, float band) {
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    float* slice = phi.row(0, k);
    const std::size_t samples = phi.index(0, 0, 1);
    for (std::size_t n = 0; n < samples; ++n) slice[n] = std::clamp(slice[n] - offset, -band, band);
  });
}

/// Sides of the grid's samples as the nearest voxels have them.
DenseMask nearestVoxels(const Segmentation& segmentation, const Tissue& tissue, const GridPlan& plan,
                        const DenseField& phi, const Eigen::Isometry3d& frame) {
  const LabelCrop crop = cropLabel(segmentation, tissue, Eigen::Vector3i::Ones(), plan.lastAxis);
  const Eigen::Affine3d toCrop = crop.indexToPhysical.inverse() * frame * Eigen::Scaling(plan.h);
  const Eigen::Array3d last = (crop.coverage.size - Eigen::Vector3i::Ones()).cast<double>();
  DenseMask inside(phi.size);
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    for (int j = 0; j < phi.size.y(); ++j) {
      std::uint8_t* row = inside.row(j, k);
      Eigen::Array3d at = toCrop * Eigen::Vector3d(0, j, k);
      for (int i = 0; i < phi.size.x(); ++i, at += toCrop.linear().col(0).array()) {
        const Eigen::Array3i voxel = (at.max(0).min(last) + 0.5).cast<int>();
        row[i] = crop.coverage(voxel[0], voxel[1], voxel[2]) > 0 ? 1 : 0;
      }
    }
  });
  return inside;
}

}  // namespace

double defaultGridSpacing(const ImageGeometry& geometry) {
  return std::max(geometry.spacing.minCoeff(), 0.5 * geometry.meanSpacing());
}

DenseLevelSet denseLevelSetFromLabels(const Segmentation& segmentation, const Tissue& tissue,
                                      const LevelSetFromLabelsOptions& options,
                                      LevelSetFromLabelsReport* report) {
  checkOptions(options);
  const GridPlan plan = planGrid(segmentation.geometry, options);
  TissueField field = tissueField(segmentation, tissue, plan, options.smoothingVoxels);

  const Eigen::Vector3d spacing = Eigen::Vector3d::Constant(plan.h);
  bandDistance(field.phi, spacing, plan.reach);
  const double volume = static_cast<double>(tissue.voxels) * segmentation.geometry.voxelVolume();
  const double offset =
      options.smoothingVoxels > 0 ? volumeOffset(field.phi, spacing, volume, plan.largestOffset) : 0;
  const double band = options.bandVoxels * plan.h;
  moveSurface(field.phi, static_cast<float>(offset), static_cast<float>(band));
  std::int64_t held = 0;
  if (options.preserveTopology && plan.block == Eigen::Vector3i::Ones()) {
    constexpr double kHoldVoxels = 0.1;  // so few samples and so near that phi need not be marched again
    held = holdTopology(nearestVoxels(segmentation, tissue, plan, field.phi, field.frame), field.phi,
                        static_cast<float>(kHoldVoxels * plan.h));
  }
  if (report != nullptr) *report = {field.iso, plan.thick, volume, fieldVolume(field.phi, spacing), held};
  return {std::move(field.phi), field.frame, plan.h, band};
}

}  // namespace sinew
