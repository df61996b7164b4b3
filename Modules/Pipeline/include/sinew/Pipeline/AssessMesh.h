#pragma once

#include "sinew/Mesher/QualityHistogram.h"
#include "sinew/Pipeline/MeshTissues.h"

#include <filesystem>
#include <optional>
#include <string>

namespace sinew {

/// What can be said of a mesh in a file.
struct MeshAssessment {
  std::string file;
  MeshQuality quality;
  std::vector<WorstElement> worst;  ///< as in TissueReport
  QualityHistogram histogram;
  MeshConditions conditions;
  MeshTopology topology;
  std::string tissue;                ///< what it was compared with; empty without a reference
  std::optional<Fidelity> fidelity;  ///< with a reference
  LostPieces lost;                   ///< with a reference
};

/// Reads and measures a mesh.
/// @throws std::runtime_error naming the file when it cannot be read.
MeshAssessment assessMesh(const std::filesystem::path& file);

/// The same, compared with a tissue of a segmentation; the level set is made anew.
/// @param wish  the tissue, as in selectTissues; empty: the one whose file stem the mesh has, or else whose
/// label
///              all its tets have
/// @throws std::runtime_error; std::invalid_argument when `wish` fits none or several tissues.
MeshAssessment assessMesh(const std::filesystem::path& file, const Segmentation& reference,
                          const std::string& wish, const Smoothing& smoothing = {});

}  // namespace sinew
