#include "sinew/LevelSet/Smooth.h"

#include "SimplePoint.h"
#include "sinew/LevelSet/FieldVolume.h"
#include "sinew/LevelSet/GaussianSmoothing.h"
#include "sinew/LevelSet/MeanCurvatureMotion.h"
#include "sinew/LevelSet/Redistance.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

constexpr double kVolumeTolerance = 1e-3;
constexpr int kLargestSigma = 100;

void checkOptions(const SmoothOptions& options, double spacing) {
  const auto require = [](const char* what, double value) {
    if (!(value >= 0) || !std::isfinite(value))
      throw std::invalid_argument("smooth: " + std::string(what) + " must not be negative, got " +
                                  std::to_string(value));
  };
  require("time", options.time);
  require("sigma", options.sigma);
  if (options.sigma > kLargestSigma * spacing)
    throw std::invalid_argument("smooth: sigma must not be above " + std::to_string(kLargestSigma) +
                                " samples of " + std::to_string(spacing) + " mm, got " +
                                std::to_string(options.sigma) + " mm");
}

bool keeps(Preserve preserve, Preserve what) { return preserve == what || preserve == Preserve::Both; }

/// Whether one of the outermost `layers` of samples is in the band.
bool bandNearBorder(const DenseLevelSet& levelSet, int layers) {
  const DenseField& phi = levelSet.phi;
  const auto inner = [layers](int index, int size) { return index >= layers && index + layers < size; };
  for (int k = 0; k < phi.size.z(); ++k)
    for (int j = 0; j < phi.size.y(); ++j) {
      const float* row = phi.row(j, k);
      const bool innerRow = inner(j, phi.size.y()) && inner(k, phi.size.z());
      for (int i = 0; i < phi.size.x(); ++i) {
        if (innerRow && i == layers) i = std::max(i, phi.size.x() - layers);
        if (row[i] < levelSet.band) return true;
      }
    }
  return false;
}

/// A shape on its way, with the samples' sides as they were, both on one box.
struct Smoothed {
  DenseLevelSet shape;
  DenseLevelSet original;  ///< empty when its topology does not matter
};

/// Leaves as much room around the shape as one move of the surface may take.
void makeRoom(Smoothed& smoothed) {
  const int layers = static_cast<int>(std::ceil(smoothed.shape.band / smoothed.shape.voxelSize));
  if (!bandNearBorder(smoothed.shape, layers)) return;
  const Eigen::Vector3i around = Eigen::Vector3i::Constant(layers);
  const Eigen::Vector3i upper = smoothed.shape.phi.size - Eigen::Vector3i::Ones() + around;
  smoothed.shape = onBox(smoothed.shape, -around, upper);
  if (!smoothed.original.phi.values.empty()) smoothed.original = onBox(smoothed.original, -around, upper);
  redistance(smoothed.shape);
}

bool hasInside(const DenseLevelSet& levelSet) {
  return std::ranges::any_of(levelSet.phi.values, [](float value) { return value < 0; });
}

/// Moves the surface until the volume is `volume`, as far at a time as the band reaches.
/// @return by how much outward, mm
double setVolume(Smoothed& smoothed, double volume) {
  constexpr int kMostMoves = 20;
  const Eigen::Vector3d spacing = Eigen::Vector3d::Constant(smoothed.shape.voxelSize);
  const double reach = smoothed.shape.band - 2 * smoothed.shape.voxelSize;
  double moved = 0;
  for (int n = 0; n < kMostMoves && hasInside(smoothed.shape); ++n) {
    if (n > 0) redistance(smoothed.shape);
    makeRoom(smoothed);
    const double level = volumeKeepingLevel(smoothed.shape.phi, spacing, volume, -reach, reach);
    const auto band = static_cast<float>(smoothed.shape.band), shift = static_cast<float>(level);
    for (float& value : smoothed.shape.phi.values) value = std::clamp(value - shift, -band, band);
    moved += level;
    constexpr double kWithinReach = 0.99;
    if (std::abs(level) < kWithinReach * reach) break;
  }
  return moved;
}

/// Motion by mean curvature; with `volume`, in stages after which the surface moves back to keep it, so that
/// nothing shrinks away meanwhile. @return by how much outward, mm
double moveByCurvature(Smoothed& smoothed, double time, std::optional<double> volume) {
  constexpr double kStage = 4.0 / 3;  // squared samples: as long as the motion goes without a redistance
  const double h = smoothed.shape.voxelSize;
  const int stages = volume ? static_cast<int>(std::ceil(time / (kStage * h * h))) : 1;
  double moved = 0;
  for (int stage = 0; stage < stages; ++stage) {
    meanCurvatureMotion(smoothed.shape.phi, h, time / stages, smoothed.shape.band);
    if (volume && stage + 1 < stages) moved += setVolume(smoothed, *volume);
  }
  return moved;
}

}  // namespace

SmoothReport smooth(DenseLevelSet& levelSet, const SmoothOptions& options) {
  checkOptions(options, levelSet.voxelSize);
  SmoothReport report;
  report.volumeBefore = shapeVolume(levelSet);
  report.before = shapeTopology(levelSet);
  const bool keepsTopology = keeps(options.preserve, Preserve::Topology);
  const bool keepsVolume = keeps(options.preserve, Preserve::Volume);
  Smoothed smoothed{levelSet, keepsTopology ? levelSet : DenseLevelSet()};
  makeRoom(smoothed);
  if (options.sigma > 0) {
    gaussianSmoothing(smoothed.shape.phi, Eigen::Vector3d::Constant(options.sigma / levelSet.voxelSize));
    redistance(smoothed.shape);
  }
  double moved = 0;
  if (options.time > 0)
    moved = moveByCurvature(smoothed, options.time,
                            keepsVolume ? std::optional(report.volumeBefore) : std::nullopt);

  constexpr float kHoldVoxels = 0.1F;
  const float hold = kHoldVoxels * static_cast<float>(levelSet.voxelSize);
  constexpr int kMostTrials = 4;  // what the topology holds back changes the volume a little
  double aim = report.volumeBefore;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    Smoothed result = smoothed;
    report.offset = keepsVolume ? moved + setVolume(result, aim) : 0;
    if (keepsTopology)
      report.heldSamples = holdTopology(insideOf(result.original.phi), result.shape.phi, hold);
    if (report.offset != 0 || report.heldSamples > 0) redistance(result.shape);
    levelSet = std::move(result.shape);
    report.volumeAfter = shapeVolume(levelSet);
    const double miss = report.volumeBefore - report.volumeAfter;
    if (!keepsTopology || !keepsVolume || std::abs(miss) <= kVolumeTolerance * report.volumeBefore) break;
    aim += miss;
  }
  report.after = shapeTopology(levelSet);
  return report;
}

}  // namespace sinew
