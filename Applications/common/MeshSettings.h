#pragma once

#include "Option.h"
#include "sinew/Pipeline/MeshTissues.h"
#include "sinew/Segmentation/ReadSegmentation.h"

namespace sinew {

/// What a person chooses about meshing: in `sinew mesh` and in Slicer's Sinew Mesher.
struct MeshSettings {
  std::vector<std::string> tissues;     ///< wishes as in selectTissues; none: all
  std::vector<std::string> sizes;       ///< TISSUE=LENGTH
  std::vector<std::string> smoothings;  ///< TISSUE=HOW
  std::string method = "optimization";
  std::vector<std::string> physics;  ///< KEY=VALUE
  ReadSegmentationOptions reading;
  MeshTissuesOptions meshing;
};

/// The options of `settings`, as rows; the settings must outlive them.
std::vector<Option> tissueOptions(MeshSettings& settings);   ///< which tissues, and their names
std::vector<Option> meshingOptions(MeshSettings& settings);  ///< the rest

/// settings.meshing with the pairs of the lists put in.
/// @throws CLI::ValidationError on a pair that is none
MeshTissuesOptions resolved(const MeshSettings& settings);

/// Rows that several commands share.
Option lutOption(ReadSegmentationOptions& reading);
Option fractionalOption(ReadSegmentationOptions& reading);
Option smoothingOption(Smoothing& smoothing);

}  // namespace sinew
