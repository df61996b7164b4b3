#include "CommandLine.h"
#include "FailureSummary.h"
#include "Interrupt.h"
#include "MeshFileSettings.h"
#include "MeshSettings.h"
#include "ProgressDisplay.h"
#include "TextTable.h"
#include "TissueScene.h"
#include "commands.h"
#include "sinew/Pipeline/FileNames.h"
#include "sinew/Pipeline/Memory.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Pipeline/Report.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/SelectTissues.h"

#include <chrono>
#include <iostream>
#include <numeric>

namespace sinew {
namespace {

constexpr const char* kReportName = "report.json";

struct MeshCommand {
  std::string input, folder, format;
  bool combined = false;
  MeshSettings settings;
  MeshFileSettings files;
};

void addOptions(CommandLine& line, MeshCommand& command) {
  CLI::App& app = line.app;
  app.add_option("INPUT", command.input,
                 "segmentation: .nrrd, .seg.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd, DICOM SEG")
      ->required();
  app.add_option("-o,--output", command.folder,
                 "folder for the meshes, scene.mrml and report.json; made if missing")
      ->type_name("DIR")
      ->required()
      ->check([](const std::string& folder) {
        return folder.empty() ? std::string("an empty name is no folder") : std::string();
      });
  addOptions(app, tissueOptions(command.settings));
  addOption(app, fractionalOption(command.settings.reading));
  addOptions(app, meshingOptions(command.settings));
  addOption(app, formatOption(command.format));
  app.add_flag("--combined", command.combined,
               "also write one file of all tissues, side by side, with their labels, names and colours");
  addOptions(app, meshFileOptions(command.files));
  app.get_option("--target-tets")->excludes(app.get_option("--edge-length"));
  app.footer(
      "Lengths are mm, or voxels with the suffix vox: 1vox is the cube root of the voxel volume.\n"
      "Exit code 0: every tissue is meshed or too small for the lattice; 1: failed, or a tissue failed.");
}

double totalSeconds(const TissueReport& report) {
  return std::accumulate(report.seconds.begin(), report.seconds.end(), 0.,
                         [](double sum, const auto& stage) { return sum + stage.second; });
}

std::int64_t countOf(TissueStatus status, const std::vector<TissueReport>& reports) {
  return std::count_if(reports.begin(), reports.end(),
                       [&](const auto& report) { return report.status == status; });
}

TextTable tissueTable(const std::vector<TissueReport>& reports) {
  TextTable table({{"tissue", Align::Left},
                   {"status", Align::Left},
                   {"edge, mm"},
                   {"tets"},
                   {"max AR"},
                   {"mean AR"},
                   {"dihedral, deg"},
                   {"volume, %"},
                   {"seconds"}});
  for (const TissueReport& report : reports) {
    const std::string seconds = fixed(totalSeconds(report), 1);
    if (report.status != TissueStatus::Meshed) {
      const Tone tone = report.status == TissueStatus::Lost ? Tone::Warning : Tone::Bad;
      table.add({report.name,
                 {toString(report.status), tone},
                 fixed(report.edgeLength, 3),
                 "-",
                 "-",
                 "-",
                 "-",
                 "-",
                 seconds});
      continue;
    }
    const MeshQuality& quality = report.quality;
    const double volumeError = 100 * (report.fidelity.volume / report.fidelity.labelVolume - 1);
    table.add({report.name,
               {toString(report.status), Tone::Good},
               fixed(report.edgeLength, 3),
               grouped(quality.tets),
               fixed(quality.maxAspectRatio, 2),
               fixed(quality.meanAspectRatio, 2),
               fixed(quality.minDihedralDeg, 1) + " - " + fixed(quality.maxDihedralDeg, 1),
               signedFixed(volumeError, 2),
               seconds});
  }
  return table;
}

void printResult(std::ostream& stream, const MeshingReport& run, const std::filesystem::path& reportFile) {
  tissueTable(run.tissues).print(stream);
  stream << '\n';
  for (const TissueReport& report : run.tissues)
    if (!report.message.empty())
      stream << printable(report.name) << " (" << toString(report.status)
             << "): " << printable(report.message) << '\n';
  std::int64_t tets = 0;
  for (const TissueReport& report : run.tissues)
    if (report.status == TissueStatus::Meshed) tets += report.quality.tets;
  stream << countOf(TissueStatus::Meshed, run.tissues) << " meshed, "
         << countOf(TissueStatus::Lost, run.tissues) << " lost, "
         << countOf(TissueStatus::Failed, run.tissues) << " failed; " << grouped(tets) << " tets in "
         << fixed(run.seconds, 1) << " s, peak memory " << formatBytes(run.peakMemory)
         << "\nreport: " << reportFile.string() << '\n';
}

/// The files of a run, inside its folder.
struct OutputNames {
  std::vector<std::string> tissues;
  std::string scene, combined;  ///< empty: none

  std::vector<std::string> all() const {
    std::vector<std::string> names{kReportName};
    names.insert(names.end(), tissues.begin(), tissues.end());
    for (const std::string& name : {scene, combined})
      if (!name.empty()) names.push_back(name);
    return names;
  }
};

OutputNames outputNames(const MeshCommand& command, const Segmentation& segmentation,
                        const std::vector<int>& tissues, const MeshTissuesOptions& options) {
  const std::vector<std::string> stems = tissueFileStems(segmentation.tissues);
  OutputNames names;
  for (const int tissue : tissues) names.tissues.push_back(stems[tissue] + options.extension);
  if (command.combined) names.combined = freeFileStem("combined", stems) + options.extension;
  if (hasScene(options)) names.scene = kSceneName;
  return names;
}

MeshTissuesOptions meshingOptions(const MeshCommand& command) {
  MeshTissuesOptions options = resolved(command.settings);
  options.extension = command.format.empty() ? standardExtension(command.files) : "." + command.format;
  checkMeshFiles(command.files, "mesh" + options.extension);
  options.writing = resolved(command.files);
  return options;
}

void runMeshing(const CommandLine& line, const MeshCommand& command, const Segmentation& segmentation,
                const std::vector<int>& tissues, MeshingReport& run) {
  ProgressDisplay display(line.common);
  const auto progress = [&](const std::string& tissue, const std::string& stage, double done) {
    checkInterrupt();
    display.show(tissue, stage, done);
  };
  TissueMesh combined;
  run.tissues = meshTissues(segmentation, tissues, command.folder, run.options, progress,
                            command.combined ? &combined : nullptr);
  if (combined.mesh.tets.empty()) {
    run.combined.clear();
  } else {
    OutputFile output(std::filesystem::path(command.folder) / run.combined);
    writeMesh(combined, output.temporary(), run.options.writing);
    output.commit();
  }
}

int mesh(const CommandLine& line, MeshCommand& command) {
  const auto start = std::chrono::steady_clock::now();
  MeshingReport run;
  run.options = meshingOptions(command);
  checkOutputFolder(command.folder, {kReportName}, line.common.force);
  const Segmentation segmentation = readSegmentation(command.input, command.settings.reading);
  line.printWarnings(segmentation);
  const std::vector<int> tissues = selectTissues(segmentation, command.settings.tissues);
  const OutputNames names = outputNames(command, segmentation, tissues, run.options);
  checkOutputFolder(command.folder, names.all(), line.common.force);

  const InterruptScope interruptible;
  const OutputFolder folder(command.folder);
  run.input = command.input;
  run.wishes = command.settings.tissues;
  run.voxel = segmentation.geometry.meanSpacing();
  run.threads = threadCount();
  run.scene = names.scene;
  run.combined = names.combined;
  runMeshing(line, command, segmentation, tissues, run);
  if (countOf(TissueStatus::Meshed, run.tissues) == 0) run.scene.clear();
  if (!run.scene.empty())
    writeTissueScene(run.tissues, std::filesystem::path(command.folder) / run.scene, run.options.writing);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.peakMemory = peakMemory();

  const std::string document = toJson(run);
  const std::filesystem::path reportFile = std::filesystem::path(command.folder) / kReportName;
  writeTextFile(reportFile, document);
  line.writeJson(document);
  if (std::ostream* stream = line.tables()) printResult(*stream, run, reportFile);
  const std::string failures = failureSummary(run.tissues);
  if (!failures.empty()) throw std::runtime_error(failures);
  if (countOf(TissueStatus::Meshed, run.tissues) == 0)
    throw std::runtime_error(command.input +
                             ": every tissue is too small for the lattice; use a smaller --edge-length");
  return 0;
}

}  // namespace

int runMesh(const std::vector<std::string>& arguments) {
  CommandLine line("mesh", "Turns every tissue of a segmentation into a tetrahedral mesh.");
  MeshCommand command;
  addOptions(line, command);
  return line.run(arguments, [&] { return mesh(line, command); });
}

}  // namespace sinew
