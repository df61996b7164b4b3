#include "sinew/Pipeline/AssessMesh.h"

#include "LevelSetSurface.h"
#include "MeasureFidelity.h"
#include "TissueLevelSet.h"
#include "WorstElements.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/Pipeline/FileNames.h"
#include "sinew/Segmentation/SelectTissues.h"

#include <algorithm>
#include <stdexcept>

namespace sinew {
namespace {

MeshAssessment assess(const std::filesystem::path& file, const TetMesh& mesh, const MeshBoundary& boundary) {
  MeshAssessment assessment;
  assessment.file = file.string();
  assessment.quality = meshQuality(mesh);
  assessment.worst = worstElements(mesh, assessment.quality);
  assessment.histogram = qualityHistogram(mesh);
  assessment.conditions = meshConditions(mesh, boundary);
  assessment.topology = meshTopology(mesh, boundary);
  return assessment;
}

std::vector<int> tissuesOfStem(const Segmentation& reference, const std::string& stem) {
  const std::vector<std::string> stems = tissueFileStems(reference.tissues);
  const auto found = std::find(stems.begin(), stems.end(), stem);
  return found == stems.end() ? std::vector<int>{}
                              : std::vector<int>{static_cast<int>(found - stems.begin())};
}

std::vector<int> tissuesOfLabels(const Segmentation& reference, const std::vector<std::int32_t>& labels) {
  std::vector<int> tissues;
  for (std::size_t t = 0; t < reference.tissues.size(); ++t) {
    const std::int32_t label = reference.tissues[t].label;
    if (std::all_of(labels.begin(), labels.end(), [&](std::int32_t other) { return other == label; }))
      tissues.push_back(static_cast<int>(t));
  }
  return tissues;
}

const Tissue& tissueOf(const std::filesystem::path& file, const TetMesh& mesh, const Segmentation& reference,
                       const std::string& wish) {
  std::vector<int> tissues =
      wish.empty() ? tissuesOfStem(reference, file.stem().string()) : selectTissues(reference, {wish});
  if (tissues.empty()) tissues = tissuesOfLabels(reference, mesh.labels);
  if (tissues.size() != 1)
    throw std::invalid_argument(file.string() + ": " + std::to_string(tissues.size()) + " tissues of " +
                                reference.source + " fit; say which one with --tissue");
  return reference.tissues[tissues.front()];
}

}  // namespace

MeshAssessment assessMesh(const std::filesystem::path& file) {
  const TetMesh mesh = readMesh(file).mesh;
  return assess(file, mesh, meshBoundary(mesh));
}

MeshAssessment assessMesh(const std::filesystem::path& file, const Segmentation& reference,
                          const std::string& wish, const Smoothing& smoothing) {
  const TetMesh mesh = readMesh(file).mesh;
  const Tissue& tissue = tissueOf(file, mesh, reference, wish);
  const MeshBoundary boundary = meshBoundary(mesh);
  MeshAssessment assessment = assess(file, mesh, boundary);
  // As `sinew mesh` makes it at its default edge length, so that the zero sets are the same.
  const MeshTissuesOptions meshing;
  const double edge = meshing.edgeLength.millimetres(reference.geometry.meanSpacing());
  const TissueLevelSet made =
      makeTissueLevelSet(reference, tissue, planTissue(reference, tissue, {edge, false, smoothing}, meshing));
  const LevelSetSurface surface(made.levelSet);
  const FidelityReport fidelity =
      measureFidelity(mesh, boundary.triangles, {.phi = surface, .frame = made.levelSet.frame}, made.volumes,
                      reference, tissue);
  assessment.tissue = tissue.name;
  assessment.fidelity = fidelity.fidelity;
  assessment.lost = fidelity.lost;
  return assessment;
}

}  // namespace sinew
