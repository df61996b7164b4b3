#include "sinew/LevelSet/LevelSetFromLabels.h"

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

#include <Eigen/SVD>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

/// The volume may be corrected by an offset of this much; the march goes as far beyond the band.
constexpr double kLargestOffsetVoxels = 0.5;
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

/// What the geometry and the options decide before a voxel is read.
struct Plan {
  double h = 1;                                      ///< spacing of the level set, mm
  Eigen::Vector3i block = Eigen::Vector3i::Ones();   ///< voxels per cell, along the axes of the image
  bool thick = false;                                ///< interpolate slices by shape
  int lastAxis = 2;                                  ///< image axis across the slices
  Eigen::Vector3i margin = Eigen::Vector3i::Zero();  ///< cells, along the axes of the image
  double clear = 0;                                  ///< the narrowest margin, mm
  double largestOffset = 0;                          ///< mm
  double reach = 0;                                  ///< half width of the march, mm
};

/// Standard deviation along an axis, cells: a level set coarser than the voxels is smoothed to its own
/// spacing. Blocks of n voxels have already smoothed by the variance (n^2 - 1)/12 of n points in a row.
double sigmaAlong(double smoothingVoxels, double cell, int block, double h) {
  const double voxel = cell / block;
  const double voxels = smoothingVoxels * std::max(1.0, h / voxel);
  return std::sqrt(std::max(0.0, voxels * voxels - (block * block - 1) / 12.0)) / block;
}

Plan makePlan(const ImageGeometry& geometry, const LevelSetFromLabelsOptions& options) {
  Plan plan;
  plan.h = options.gridSpacing > 0 ? options.gridSpacing : defaultGridSpacing(geometry);
  for (int a = 0; a < 3; ++a)
    plan.block[a] = std::max(1, static_cast<int>(plan.h / geometry.spacing[a] + 1e-6));
  const Eigen::Vector3d spacing = geometry.spacing.cwiseProduct(plan.block.cast<double>());
  int thickest = 2;
  plan.thick = spacing.maxCoeff(&thickest) >= options.thickSliceRatio * spacing.minCoeff();
  if (plan.thick) plan.lastAxis = thickest;
  plan.largestOffset = kLargestOffsetVoxels * std::max(plan.h, defaultGridSpacing(geometry));
  plan.reach = options.bandVoxels * plan.h + plan.largestOffset;
  constexpr double kKernelSigmas = 3.5, kFreeCells = 2;
  for (int a = 0; a < 3; ++a) {
    const bool across = plan.thick && a == plan.lastAxis;
    const double kernel =
        across ? 0 : kKernelSigmas * sigmaAlong(options.smoothingVoxels, spacing[a], plan.block[a], plan.h);
    plan.margin[a] = static_cast<int>(std::ceil(
        std::max(kernel, 1.0) + kFreeCells * std::max(1.0, plan.h / spacing[a]) * (across ? 0.5 : 1)));
  }
  plan.clear = plan.margin.cast<double>().cwiseProduct(spacing).minCoeff();
  return plan;
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

/// Where the samples of the level set's grid lie, and how they are taken from the crop's raster.
struct GridPlacement {
  Eigen::Isometry3d frame;
  Eigen::Vector3i size;
  Eigen::Vector3d first;  ///< of the aligned grid's first sample, mm from the raster's first
  bool aligned = false;   ///< grid axes are raster axes
};

/// The rotation nearest to the raster's axes (polar decomposition); the raster is right-handed.
Eigen::Matrix3d nearestRotation(const LabelCrop& crop) {
  const Eigen::Matrix3d axes = crop.indexToPhysical.linear() * crop.spacing.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// The grid holds the raster and, around the tissue, at least the reach of the march.
GridPlacement placeGrid(const LabelCrop& crop, const Plan& plan) {
  GridPlacement place;
  const double h = plan.h;
  const Eigen::Matrix3d rotation = nearestRotation(crop);
  const Eigen::Matrix3d steps =
      rotation.transpose() * crop.indexToPhysical.linear();  // raster steps in the frame
  const Eigen::Vector3d last = (crop.coverage.size - Eigen::Vector3i::Ones()).cast<double>();
  constexpr double kAlignedVoxels = 0.01;
  const Eigen::Matrix3d slant = steps - Eigen::Matrix3d(crop.spacing.asDiagonal());
  place.aligned = (slant * last.asDiagonal()).cwiseAbs().maxCoeff() < kAlignedVoxels * h;

  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero(), Eigen::Vector3d(last.cwiseProduct(crop.spacing)));
  if (!place.aligned)
    for (int corner = 0; corner < 8; ++corner)
      box.extend(steps * last.cwiseProduct(Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2)));
  const double around = std::ceil(std::max(0.0, plan.reach - plan.clear) / h + 1) * h;
  box = {box.min().array() - around, box.max().array() + around};
  for (int a = 0; a < 3; ++a) place.size[a] = static_cast<int>(std::floor(box.sizes()[a] / h + 1e-6)) + 1;
  place.first = box.min();
  place.frame.linear() = rotation;
  place.frame.translation() = crop.indexToPhysical.translation() + rotation * box.min();
  return place;
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
                       const Plan& plan) {
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
TissueField tissueField(const Segmentation& segmentation, const Tissue& tissue, const Plan& plan,
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

}  // namespace

double defaultGridSpacing(const ImageGeometry& geometry) {
  return std::max(geometry.spacing.minCoeff(), 0.5 * geometry.meanSpacing());
}

DenseLevelSet denseLevelSetFromLabels(const Segmentation& segmentation, const Tissue& tissue,
                                      const LevelSetFromLabelsOptions& options,
                                      LevelSetFromLabelsReport* report) {
  checkOptions(options);
  const Plan plan = makePlan(segmentation.geometry, options);
  TissueField field = tissueField(segmentation, tissue, plan, options.smoothingVoxels);

  const Eigen::Vector3d spacing = Eigen::Vector3d::Constant(plan.h);
  bandDistance(field.phi, spacing, plan.reach);
  const double volume = static_cast<double>(tissue.voxels) * segmentation.geometry.voxelVolume();
  const double offset =
      options.smoothingVoxels > 0 ? volumeOffset(field.phi, spacing, volume, plan.largestOffset) : 0;
  const double band = options.bandVoxels * plan.h;
  moveSurface(field.phi, static_cast<float>(offset), static_cast<float>(band));
  if (report != nullptr) *report = {field.iso, plan.thick, volume, fieldVolume(field.phi, spacing)};
  return {std::move(field.phi), field.frame, plan.h, band};
}

}  // namespace sinew
