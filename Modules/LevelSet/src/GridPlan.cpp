#include "GridPlan.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

/// The march goes as far beyond the band as an offset may correct the volume.
constexpr double kLargestOffsetVoxels = 0.5;

/// The rotation nearest to three unit vectors that are right-handed (polar decomposition).
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& axes) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// A multiple of h at or below x; the nearest one when x is one up to rounding.
double multipleBelow(double x, double h) {
  constexpr double kRounding = 1e-3;
  return std::floor(x / h + kRounding) * h;
}

}  // namespace

double sigmaAlong(double smoothingVoxels, double cell, int block, double h) {
  const double voxel = cell / block;
  const double voxels = smoothingVoxels * std::max(1.0, h / voxel);
  return std::sqrt(std::max(0.0, voxels * voxels - (block * block - 1) / 12.0)) / block;
}

GridPlan planGrid(const ImageGeometry& geometry, const LevelSetFromLabelsOptions& options) {
  GridPlan plan;
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
  if (options.onCommonLattice) plan.lattice = commonLattice(geometry, plan.h);
  return plan;
}

GridPlacement placeGrid(const LabelCrop& crop, const GridPlan& plan) {
  GridPlacement place;
  const double h = plan.h;
  const Eigen::Matrix3d rotation =
      plan.lattice
          ? Eigen::Matrix3d(plan.lattice->frame.linear())
          : nearestRotation(crop.indexToPhysical.linear() * crop.spacing.cwiseInverse().asDiagonal());
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
  Eigen::Vector3d first = box.min();
  if (plan.lattice) {
    const Eigen::Vector3d raster = plan.lattice->frame.inverse() * crop.indexToPhysical.translation();
    for (int a = 0; a < 3; ++a) first[a] = multipleBelow(raster[a] + first[a], h) - raster[a];
  }
  for (int a = 0; a < 3; ++a)
    place.size[a] = static_cast<int>(std::floor((box.max()[a] - first[a]) / h + 1e-6)) + 1;
  place.first = first;
  place.frame.linear() = rotation;
  place.frame.translation() = crop.indexToPhysical.translation() + rotation * first;
  return place;
}

SampleLattice commonLattice(const ImageGeometry& geometry, double spacing) {
  const GridPlan plan = planGrid(geometry, {.gridSpacing = spacing});
  SampleLattice lattice;
  lattice.spacing = plan.h;
  lattice.frame.linear() = nearestRotation(rasterAxes(geometry, plan.lastAxis).directions);
  lattice.frame.translation() = geometry.origin;
  return lattice;
}

}  // namespace sinew
