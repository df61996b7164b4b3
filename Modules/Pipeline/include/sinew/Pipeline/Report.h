#pragma once

#include "sinew/Pipeline/AssessMesh.h"
#include "sinew/Pipeline/MeshTissues.h"
#include "sinew/Segmentation/Segmentation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sinew {

/// The version of Sinew, e.g. `0.1.0`.
const char* version();

/// One run of meshTissues.
struct MeshingReport {
  std::string input;                ///< as given
  std::vector<std::string> wishes;  ///< tissues asked for; none: all
  double voxel = 0;                 ///< what `vox` stands for, mm
  MeshTissuesOptions options;
  int threads = 0;
  double seconds = 0;           ///< wall time of the run
  double peakMemory = 0;        ///< bytes
  std::string combined, scene;  ///< names of the files of all tissues, inside the output folder; empty: none
  std::vector<TissueReport> tissues;
};

/// `meshed`, `lost` or `failed`.
const char* toString(TissueStatus status);

/// The documents that the program writes: JSON, two spaces of indent, a newline at the end. Lengths in mm.
std::string toJson(const MeshingReport& report);
std::string toJson(const std::vector<MeshAssessment>& meshes);
/// @param pieces  26-connected pieces of each tissue, in the order of the table
std::string toJson(const Segmentation& segmentation, const std::vector<std::int64_t>& pieces);

}  // namespace sinew
