#include "TissueLevelSet.h"

#include "Digits.h"
#include "sinew/LevelSet/LabelCrop.h"
#include "sinew/LevelSet/Smooth.h"

#include <cmath>

namespace sinew {
namespace {

ShapeTopology topologyOfVoxels(const Segmentation& segmentation, const Tissue& tissue) {
  DenseLevelSet voxels{.phi = cropLabel(segmentation, tissue, Eigen::Vector3i::Ones()).coverage};
  for (float& value : voxels.phi.values) value = 0.5F - value;
  return shapeTopology(voxels);
}

}  // namespace

TissueLevelSet makeTissueLevelSet(const Segmentation& segmentation, const Tissue& tissue,
                                  const TissuePlan& plan) {
  TissueLevelSet result;
  result.levelSet = denseLevelSetFromLabels(segmentation, tissue, plan.levelSet, &result.volumes);
  result.smoothing.voxels = topologyOfVoxels(segmentation, tissue);
  if (plan.motion > 0) {
    const SmoothReport smoothed = smooth(result.levelSet, {.time = plan.motion});
    result.volumes.levelSetVolume = smoothed.volumeAfter;
    result.smoothing.levelSet = smoothed.after;
    result.smoothing.volumeChange = smoothed.volumeAfter / smoothed.volumeBefore - 1;
  } else {
    result.smoothing.levelSet = shapeTopology(result.levelSet);
  }
  return result;
}

std::string smoothingWarning(const SmoothingReport& report) {
  const auto change = [](const char* what, std::int64_t before, std::int64_t after) {
    return std::to_string(after) + " " + what + " instead of " + std::to_string(before);
  };
  std::string text;
  if (report.levelSet.components != report.voxels.components)
    text = change("pieces", report.voxels.components, report.levelSet.components);
  if (report.levelSet.cavities != report.voxels.cavities)
    text += (text.empty() ? "" : ", ") + change("cavities", report.voxels.cavities, report.levelSet.cavities);
  constexpr double kVolumeTolerance = 1.5e-3;  // smooth keeps it within 1e-3
  if (std::abs(report.volumeChange) > kVolumeTolerance)
    text += (text.empty() ? "" : ", ") + threeDigits(100 * (1 + report.volumeChange)) + " % of the volume";
  return text.empty() ? "" : "smoothing left " + text + "; try less of it";
}

}  // namespace sinew
