#pragma once

#include "ProgressSum.h"
#include "TissuePlan.h"
#include "sinew/Pipeline/MeshTissues.h"

namespace sinew {

/// One tissue of a run.
struct TissueJob {
  std::size_t slot = 0;  ///< place in the list of reports
  int tissue = 0;        ///< index into the segmentation's table
  std::string file;      ///< name inside the output folder; empty: none is written
  TissueWish wish;
  TissuePlan plan;
  TissueMesh* kept = nullptr;  ///< receives the mesh that was written, if not null
  bool searchSize = false;     ///< the plan is only where the search for the wanted number of tets begins
  TissueCost cost;
};

/// Voxels to a written and measured mesh. Whatever goes wrong is in the report.
/// @param availableMemory  bytes; a mesh that would take more fails
/// @throws ProgressSum::Stopped only.
TissueReport meshOneTissue(const Segmentation& segmentation, const TissueJob& job,
                           const std::filesystem::path& folder, const MeshTissuesOptions& options,
                           double availableMemory, ProgressSum& progress);

}  // namespace sinew
