// Slicer module: a segmentation to tetrahedral meshes.
#include "FailureSummary.h"
#include "Interrupt.h"
#include "MeshSettings.h"
#include "Module.h"
#include "Process.h"
#include "TissueScene.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/Pipeline/Report.h"
#include "sinew/Pipeline/StagedFolder.h"
#include "sinew/Segmentation/NearestNames.h"
#include "sinew/Segmentation/SelectTissues.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace sinew {
namespace {

constexpr double kMeshingShare = 0.95;  // of the time; the rest writes the combined mesh

struct Mesher {
  std::string input, output, folder;
  int threads = 0;
  MeshSettings settings;
  std::int64_t tissues = 0, tets = 0;  ///< results
};

ModuleGroup filesGroup(Mesher& mesher) {
  using Channel = ModuleParameter::Channel;
  return {"Input and output",
          "",
          false,
          {inputParameter(mesher.input),
           {{"output-mesh", &mesher.output, "one mesh of all tissues, with labels and colours"},
            "geometry",
            {{"type", "model"}, {"fileExtensions", ".vtu"}},
            "Mesh",
            Channel::Output},
           {{"--folder", &mesher.folder,
             "also write one mesh for each tissue into this folder, and a scene.mrml that opens them all"},
            "directory",
            {},
            "Folder of tissues",
            Channel::Output}}};
}

ModuleDescription describe(Mesher& mesher) {
  ModuleGroup tissues{"Tissues", "", false, asParameters(tissueOptions(mesher.settings))};
  ModuleGroup meshing{"Meshing", "Lengths are mm, or voxels with the suffix vox.", true,
                      asParameters(meshingOptions(mesher.settings))};
  meshing.parameters.push_back(threadsParameter(mesher.threads));
  ModuleGroup results{"Results",
                      "",
                      false,
                      {resultParameter("tissues-meshed", mesher.tissues, "tissues that got a mesh"),
                       resultParameter("tets", mesher.tets, "tetrahedra of all of them")}};
  return {"SinewMesher",
          "Sinew Mesher",
          "Segmentation.Sinew",
          "Turns every tissue of a segmentation into a tetrahedral mesh for simulation.",
          {filesGroup(mesher), std::move(tissues), std::move(meshing), std::move(results)}};
}

/// Everything that can be wrong without reading the input.
void check(const Mesher& mesher) {
  if (findMeshFormat(std::filesystem::path(mesher.output).filename().string()) == nullptr)
    throw CLI::ValidationError("output-mesh",
                               mesher.output + ": unknown kind of mesh file; known are " + meshExtensions());
}

bool namesTissue(const Segmentation& segmentation, const std::string& text) {
  const auto fits = [&](const Tissue& tissue) {
    return tissue.id == text || looseName(tissue.name) == looseName(text);
  };
  return std::ranges::any_of(segmentation.tissues, fits) ||
         std::ranges::any_of(segmentation.emptyTissues, fits);
}

/// The wishes in a list with commas between, of which names may have some as well.
std::vector<std::string> wishesIn(const Segmentation& segmentation, const std::vector<std::string>& lists) {
  std::vector<std::string> wishes;
  for (const std::string& list : lists) {
    if (namesTissue(segmentation, list)) {
      wishes.push_back(list);
      continue;
    }
    for (const std::string& wish : CLI::detail::split(list, ','))
      wishes.push_back(CLI::detail::trim_copy(wish));
  }
  return wishes;
}

/// What a person ought to know about each tissue; counts into the results.
/// @throws std::runtime_error when a tissue failed, or none is meshed
void account(Mesher& mesher, const std::vector<TissueReport>& reports, ModuleProgress& progress) {
  for (const TissueReport& report : reports) {
    if (!report.message.empty())
      progress.say(report.name + " (" + toString(report.status) + "): " + report.message);
    if (report.status != TissueStatus::Meshed) continue;
    ++mesher.tissues;
    mesher.tets += report.quality.tets;
  }
  const std::string failures = failureSummary(reports);
  if (!failures.empty()) throw std::runtime_error(failures);
  if (mesher.tissues == 0)
    throw std::runtime_error("every tissue is too small for the lattice; use a smaller edge length");
}

void run(Mesher& mesher, ModuleProgress& progress) {
  check(mesher);
  const ThreadLimit limit(mesher.threads);
  const MeshTissuesOptions options = resolved(mesher.settings);
  const Segmentation segmentation = readSegmentation(mesher.input, mesher.settings.reading);
  const std::vector<int> tissues =
      selectTissues(segmentation, wishesIn(segmentation, mesher.settings.tissues));

  const InterruptScope interruptible;
  std::unique_ptr<StagedFolder> folder;
  if (!mesher.folder.empty()) folder = std::make_unique<StagedFolder>(mesher.folder);
  TissueMesh combined;
  const std::vector<TissueReport> reports = meshTissues(
      segmentation, tissues, folder ? folder->temporary() : "", options,
      [&](const std::string& tissue, const std::string& stage, double done) {
        checkInterrupt();
        progress.show(kMeshingShare * done, tissue + ": " + stage);
      },
      &combined);
  account(mesher, reports, progress);
  progress.show(kMeshingShare, "writing");
  OutputFile output(mesher.output);
  writeMesh(combined, output.temporary(), options.writing);
  if (folder) {
    writeTissueScene(reports, folder->temporary() / kSceneName, options.writing);
    folder->commit();
  }
  output.commit();
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  sinew::Mesher mesher;
  return sinew::runModule(argc, argv, sinew::describe(mesher),
                          [&](sinew::ModuleProgress& progress) { sinew::run(mesher, progress); });
}
