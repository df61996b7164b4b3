#include "sinew/LevelSet/Smooth.h"

#include "SimplePoint.h"
#include "sinew/LevelSet/FieldVolume.h"
#include "sinew/LevelSet/GaussianSmoothing.h"
#include "sinew/LevelSet/MeanCurvatureMotion.h"
#include "sinew/LevelSet/Redistance.h"
#include "sinew/LevelSet/SampleLattice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

constexpr double kVolumeTolerance = 1e-3;

void checkOptions(const SmoothOptions& options) {
  const auto require = [](const char* what, double value) {
    if (!(value >= 0) || !std::isfinite(value))
      throw std::invalid_argument("smooth: " + std::string(what) + " must not be negative, got " +
                                  std::to_string(value));
  };
  require("time", options.time);
  require("sigma", options.sigma);
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

/// Leaves as much room around the shape as an offset may take.
void makeRoom(DenseLevelSet& levelSet) {
  const int layers = static_cast<int>(std::ceil(levelSet.band / levelSet.voxelSize));
  if (!bandNearBorder(levelSet, layers)) return;
  const Eigen::Vector3i around = Eigen::Vector3i::Constant(layers);
  levelSet = onBox(levelSet, -around, levelSet.phi.size - Eigen::Vector3i::Ones() + around);
  redistance(levelSet);
}

void applySmoothing(DenseLevelSet& levelSet, const SmoothOptions& options) {
  if (options.sigma > 0) {
    gaussianSmoothing(levelSet.phi, Eigen::Vector3d::Constant(options.sigma / levelSet.voxelSize));
    redistance(levelSet);
  }
  if (options.time > 0) meanCurvatureMotion(levelSet.phi, levelSet.voxelSize, options.time, levelSet.band);
}

/// Moves the surface so that the volume becomes `volume`; as far as the band reaches.
/// @return by how much outward, mm
double setVolume(DenseLevelSet& levelSet, double volume) {
  const Eigen::Vector3d spacing = Eigen::Vector3d::Constant(levelSet.voxelSize);
  const double reach = levelSet.band - 2 * levelSet.voxelSize;
  const double level = volumeKeepingLevel(levelSet.phi, spacing, volume, -reach, reach);
  const auto band = static_cast<float>(levelSet.band), shift = static_cast<float>(level);
  for (float& value : levelSet.phi.values) value = std::clamp(value - shift, -band, band);
  return level;
}

}  // namespace

SmoothReport smooth(DenseLevelSet& levelSet, const SmoothOptions& options) {
  checkOptions(options);
  SmoothReport report;
  report.volumeBefore = shapeVolume(levelSet);
  report.before = shapeTopology(levelSet);
  makeRoom(levelSet);
  const bool keepsTopology = keeps(options.preserve, Preserve::Topology);
  const DenseMask original = keepsTopology ? insideOf(levelSet.phi) : DenseMask();
  applySmoothing(levelSet, options);

  const DenseLevelSet smoothed = keepsTopology ? levelSet : DenseLevelSet();
  constexpr float kHoldVoxels = 0.1F;
  const float hold = kHoldVoxels * static_cast<float>(levelSet.voxelSize);
  constexpr int kMostTrials = 4;  // what the topology holds back changes the volume a little
  double aim = report.volumeBefore;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    if (trial > 0) levelSet.phi = smoothed.phi;
    if (keeps(options.preserve, Preserve::Volume)) report.offset = setVolume(levelSet, aim);
    if (keepsTopology) report.heldSamples = holdTopology(original, levelSet.phi, hold);
    if (report.offset != 0 || report.heldSamples > 0) redistance(levelSet);
    report.volumeAfter = shapeVolume(levelSet);
    const double miss = report.volumeBefore - report.volumeAfter;
    if (!keepsTopology || !keeps(options.preserve, Preserve::Volume) ||
        std::abs(miss) <= kVolumeTolerance * report.volumeBefore)
      break;
    aim += miss;
  }
  report.after = shapeTopology(levelSet);
  return report;
}

}  // namespace sinew
