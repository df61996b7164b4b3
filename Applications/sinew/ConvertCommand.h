#pragma once

#include "CommandLine.h"
#include "MeshFileSettings.h"
#include "sinew/Segmentation/ReadSegmentation.h"

namespace sinew {

/// `sinew convert` as given.
struct ConvertCommand {
  std::vector<std::string> inputs;
  std::string output;
  ReadSegmentationOptions reading;
  std::vector<std::string> tissues, priority, tables;
  std::string overlap = "refuse";
  bool noTable = false;
  MeshFileSettings files;
};

/// The two kinds of conversion; all inputs are of that kind. @return the machine-readable result
std::string convertSegmentation(const CommandLine& line, const ConvertCommand& command);
std::string convertMeshes(const CommandLine& line, const ConvertCommand& command);

}  // namespace sinew
