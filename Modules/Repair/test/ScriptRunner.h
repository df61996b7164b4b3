#pragma once

#include "sinew/Repair/RepairSegmentation.h"
#include "sinew/Segmentation/Segmentation.h"
#include "sinew/TestSupport/Files.h"

#include <string>
#include <vector>

namespace sinew::test {

/// 20^3 voxels of 1 mm, voxel (0,0,0) at the origin: `humerus` (1), a box of 4 x 4 x 16 voxels; `biceps` (2),
/// one of 6 x 6 x 10 beside it; `speckle` (3), one voxel; and three names that begin alike.
inline Segmentation smallArm() {
  Segmentation arm;
  arm.source = "arm.nrrd";
  arm.geometry.size = {20, 20, 20};
  arm.layers.assign(1, std::vector<std::int32_t>(8000, 0));
  const auto fill = [&](std::int32_t label, const Eigen::Vector3i& lower, const Eigen::Vector3i& upper) {
    for (int k = lower.z(); k < upper.z(); ++k)
      for (int j = lower.y(); j < upper.y(); ++j)
        for (int i = lower.x(); i < upper.x(); ++i) arm.layers[0][i + 20 * (j + 20 * k)] = label;
  };
  fill(1, {3, 3, 2}, {7, 7, 18});
  fill(2, {8, 4, 5}, {14, 10, 15});
  fill(3, {17, 17, 17}, {18, 18, 18});
  const char* names[] = {"", "humerus", "biceps", "speckle"};
  for (const std::int32_t label : {1, 2, 3}) {
    Tissue tissue;
    tissue.name = names[label];
    tissue.id = "Segment_" + std::to_string(label);
    tissue.label = label;
    tissue.color = {0.1 * label, 0.5, 0.25};
    tissue.named = true;
    tissue.tags["Finding"] = names[label];
    arm.tissues.push_back(tissue);
  }
  arm.keys["Segmentation_Source"] = "test";
  updateTissueTable(arm);
  return arm;
}

/// What a script prints, line by line, when it is only tried.
inline std::vector<std::string> printed(const std::string& script, RepairOptions options = {.check = true}) {
  std::vector<std::string> lines;
  options.print = [&](const std::string& line) { lines.push_back(line); };
  repairSegmentation(smallArm(), script, options);
  return lines;
}

/// What is said against a script; empty for a good one.
inline std::string errorOf(const std::string& script, const RepairOptions& options = {.check = true}) {
  return messageOf<std::invalid_argument>([&] { repairSegmentation(smallArm(), script, options); });
}

}  // namespace sinew::test
