#pragma once

#include "Option.h"
#include "sinew/Repair/RepairSegmentation.h"
#include "sinew/Segmentation/ReadSegmentation.h"

namespace sinew {

/// What a person chooses about repairing: in `sinew repair` and in Slicer's Sinew Repair.
struct RepairSettings {
  std::string script;                ///< file
  std::vector<std::string> globals;  ///< of the script, NAME=VALUE
  Length grid = 0;                   ///< spacing of the level sets
  Smoothing smoothing;
  ReadSegmentationOptions reading;
};

/// The options of `settings` but the script, as rows; the settings must outlive them.
std::vector<Option> repairOptions(RepairSettings& settings);

/// What repairSegmentation takes, for this input.
RepairOptions resolved(const RepairSettings& settings, const Segmentation& input);

/// The text of a script.
/// @throws std::runtime_error naming the file when it is missing, too large for a script or unreadable
std::string readScript(const std::string& file);

}  // namespace sinew
