#include "sinew/LevelSet/LevelSetFromLabels.h"

#include "sinew/LevelSet/FastMarching.h"
#include "sinew/LevelSet/FieldResampling.h"
#include "sinew/LevelSet/FieldVolume.h"
#include "sinew/LevelSet/GaussianSmoothing.h"
#include "sinew/LevelSet/LabelCrop.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/LevelSetMeasures.h"
#include "sinew/LevelSet/SliceDistances.h"
#include "sinew/LevelSet/SliceInterpolation.h"
#include "sinew/LevelSet/SliceSmoothing.h"
#include "sinew/LevelSet/SmallPieces.h"
#include "sinew/LevelSet/SurfaceLevel.h"
#include "sinew/LevelSet/VolumeKeepingIso.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

/// The march goes this much beyond the band, so that the volume can be corrected by an offset.
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
  bool thick = false;                                ///< interpolate slices by shape
  int lastAxis = 2;                                  ///< image axis across the slices
  Eigen::Vector3i margin = Eigen::Vector3i::Zero();  ///< voxels, along the axes of the image
  double reach = 0;                                  ///< half width of the march, mm
};

/// Standard deviation along an axis, voxels: a level set coarser than the voxels is smoothed to its own
/// spacing.
double sigmaAlong(double smoothingVoxels, double spacing, double h) {
  return smoothingVoxels * std::max(1.0, h / spacing);
}

Plan makePlan(const ImageGeometry& geometry, const LevelSetFromLabelsOptions& options) {
  Plan plan;
  const Eigen::Vector3d& spacing = geometry.spacing;
  plan.h = options.gridSpacing > 0 ? options.gridSpacing : defaultGridSpacing(geometry);
  int thickest = 2;
  plan.thick = spacing.maxCoeff(&thickest) >= options.thickSliceRatio * spacing.minCoeff();
  if (plan.thick) plan.lastAxis = thickest;
  plan.reach = (options.bandVoxels + kLargestOffsetVoxels) * plan.h;
  constexpr double kKernelSigmas = 3.5, kFreeVoxels = 2;
  for (int a = 0; a < 3; ++a) {
    const bool across = plan.thick && a == plan.lastAxis;
    const double kernel =
        across ? 0 : kKernelSigmas * sigmaAlong(options.smoothingVoxels, spacing[a], plan.h);
    plan.margin[a] =
        static_cast<int>(std::ceil(std::max({plan.reach / spacing[a], kernel, 1.0}) +
                                   kFreeVoxels * std::max(1.0, plan.h / spacing[a]) * (across ? 0.5 : 1)));
  }
  return plan;
}

/// A field whose zero set is the tissue's surface, on the raster of a crop.
struct SurfaceField {
  DenseField values;  ///< negative inside
  double iso = 0.5;
};

SurfaceField smoothedField(const LabelCrop& crop, std::int64_t voxels, const Eigen::Vector3d& sigma) {
  SurfaceField field{gaussianSmoothing(crop.mask, sigma), 0.5};
  if (sigma.isZero()) {
    for (float& v : field.values.values) v = 0.5F - v;
    return field;
  }
  field.iso = volumeKeepingIso(field.values, voxels);
  subtractSurfaceLevel(field.values, crop.mask, sigma, field.iso);
  const double notSmoothed = field.iso - 1;
  restoreSmallPieces(field.values, crop.mask, static_cast<float>(notSmoothed));
  return field;
}

/// Where the samples of the level set's grid lie, and how they are taken from the crop's raster.
struct GridPlacement {
  Eigen::Isometry3d frame;
  Eigen::Vector3i size;
  bool aligned = false;  ///< grid axes are raster axes, both begin at the same sample
};

/// The rotation nearest to the raster's axes (polar decomposition); the raster is right-handed.
Eigen::Matrix3d nearestRotation(const LabelCrop& crop) {
  const Eigen::Matrix3d axes = crop.indexToPhysical.linear() * crop.spacing.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

GridPlacement placeGrid(const LabelCrop& crop, double h) {
  GridPlacement place;
  const Eigen::Matrix3d rotation = nearestRotation(crop);
  const Eigen::Matrix3d steps =
      rotation.transpose() * crop.indexToPhysical.linear();  // raster steps in the frame
  const Eigen::Vector3d last = (crop.mask.size - Eigen::Vector3i::Ones()).cast<double>();
  constexpr double kAlignedVoxels = 0.01;
  const Eigen::Matrix3d slant = steps - Eigen::Matrix3d(crop.spacing.asDiagonal());
  place.aligned = (slant * last.asDiagonal()).cwiseAbs().maxCoeff() < kAlignedVoxels * h;

  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero(), Eigen::Vector3d(last.cwiseProduct(crop.spacing)));
  if (!place.aligned)
    for (int corner = 0; corner < 8; ++corner)
      box.extend(steps * last.cwiseProduct(Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2)));
  for (int a = 0; a < 3; ++a) place.size[a] = static_cast<int>(std::floor(box.sizes()[a] / h + 1e-6)) + 1;
  place.frame.linear() = rotation;
  place.frame.translation() = crop.indexToPhysical.translation() + rotation * box.min();
  return place;
}

/// Spacing that is equal enough to be taken for the grid's own: less than a hundredth of a voxel over the
/// raster.
bool sameSpacing(double spacing, double h, int samples) { return std::abs(spacing / h - 1) * samples < 0.01; }

void resampleTo(DenseField& field, int axis, double spacing, double h, int count) {
  if (sameSpacing(spacing, h, field.size[axis]) && field.size[axis] == count) return;
  field = resampleAxis(field, axis, 0, h / spacing, count);
}

std::vector<double> planes(double spacing, double h, int count, int slices) {
  std::vector<double> positions;
  for (int i = 0; i < count; ++i) positions.push_back(std::min(i * h / spacing, slices - 1.0));
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
    for (int a = 0; a < (plan.thick ? 2 : 3); ++a) resampleTo(field, a, spacing[a], plan.h, place.size[a]);
    if (!plan.thick) return field;
    return interpolateSlices(field, spacing.z(), planes(spacing.z(), plan.h, place.size.z(), field.size.z()),
                             plan.reach);
  }
  Eigen::Vector3d fieldStep = Eigen::Vector3d::Ones();  // raster index per index of `field`
  if (plan.thick) {
    const int slices = field.size.z(),
              count = static_cast<int>(std::floor((slices - 1) * spacing.z() / plan.h)) + 1;
    field = interpolateSlices(field, spacing.z(), planes(spacing.z(), plan.h, count, slices), plan.reach);
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
  for (int k = 0; k < crop.mask.size.z(); ++k)
    for (int j = 0; j < crop.mask.size.y(); ++j)
      for (int i = 0; i < crop.mask.size.x(); ++i) {
        if (crop.mask(i, j, k) == 0) continue;
        const Eigen::Vector3i at = (toGrid * Eigen::Vector3d(i, j, k)).array().round().cast<int>();
        field(at.x(), at.y(), at.z()) = inside;
      }
}

/// The offset that gives a signed distance the wanted volume; it never takes more than half of the depth.
double volumeOffset(const DenseField& phi, const Eigen::Vector3d& spacing, double volume) {
  const double largest = kLargestOffsetVoxels * spacing.minCoeff();
  const double depth = -*std::min_element(phi.values.begin(), phi.values.end());
  return volumeKeepingLevel(phi, spacing, volume, -std::min(largest, depth / 2), largest);
}

}  // namespace

double defaultGridSpacing(const ImageGeometry& geometry) {
  return std::max(geometry.spacing.minCoeff(), 0.5 * geometry.meanSpacing());
}

LevelSet levelSetFromLabels(const Segmentation& segmentation, const Tissue& tissue,
                            const LevelSetFromLabelsOptions& options, LevelSetFromLabelsReport* report) {
  checkOptions(options);
  const Plan plan = makePlan(segmentation.geometry, options);
  LabelCrop crop = cropLabel(segmentation, tissue, plan.margin, plan.lastAxis);
  const GridPlacement place = placeGrid(crop, plan.h);

  DenseField phi;
  double iso = 0.5, smoothing = options.smoothingVoxels;
  for (bool lost = true; lost; smoothing = smoothing > kLeastSmoothing ? smoothing / 2 : 0) {
    Eigen::Vector3d sigma;
    for (int a = 0; a < 3; ++a)
      sigma[a] = plan.thick && a == 2 ? 0 : sigmaAlong(smoothing, crop.spacing[a], plan.h);
    SurfaceField field = smoothedField(crop, tissue.voxels, sigma);
    iso = field.iso;
    phi = fieldOnGrid(std::move(field.values), crop, place, plan);
    lost = !hasInside(phi);
    if (lost && smoothing == 0) {
      stampVoxels(phi, crop, place, plan.h);
      lost = false;
    }
  }
  crop.mask = {};

  const Eigen::Vector3d spacing = Eigen::Vector3d::Constant(plan.h);
  fastMarching(phi, spacing, plan.reach);
  const double volume = static_cast<double>(tissue.voxels) * segmentation.geometry.voxelVolume();
  const double offset = options.smoothingVoxels > 0 ? volumeOffset(phi, spacing, volume) : 0;
  LevelSet result = levelSetFromField({phi, place.frame, plan.h, options.bandVoxels * plan.h}, offset);
  if (report != nullptr) *report = {iso, plan.thick, volume, levelSetVolume(result)};
  return result;
}

}  // namespace sinew
