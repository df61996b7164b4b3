#include "CommandLine.h"
#include "Interrupt.h"
#include "ProgressDisplay.h"
#include "TextTable.h"
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
  std::string input, folder, method = "optimization";
  std::vector<std::string> wishes, sizes, smoothings;
  ReadSegmentationOptions reading;
  MeshTissuesOptions meshing;
};

void addOptions(CommandLine& line, MeshCommand& command) {
  CLI::App& app = line.app;
  MeshTissuesOptions& meshing = command.meshing;
  app.add_option("INPUT", command.input, "segmentation: .nrrd, .seg.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd")
      ->required();
  app.add_option("-o,--output", command.folder, "folder for <tissue>.vtu and report.json; made if missing")
      ->type_name("DIR")
      ->required()
      ->check([](const std::string& folder) {
        return folder.empty() ? std::string("an empty name is no folder") : std::string();
      });
  app.add_option("--tissue", command.wishes, "mesh only this tissue; repeatable; default all")
      ->type_name("NAME|LABEL")
      ->expected(1)
      ->take_all();
  app.add_option("--lut", command.reading.lut, "colour table with the names of the labels")
      ->type_name("FILE");
  CLI::Option* edgeLength =
      line.addLength("--edge-length", meshing.edgeLength, "cube size of the lattice at the surface");
  line.addLength("--max-edge-length", meshing.maxEdgeLength,
                 "cube size deep inside; 0: eight times the edge length");
  line.addLength(
      "--min-edge-length", meshing.minEdgeLength,
      "smallest cube that refinement may make; 0: the level set's spacing, and where more than 1 % of the "
      "volume would be lost half a voxel, or a quarter of the edge length where that is more");
  app.add_option("--size", command.sizes, "edge length of one tissue; repeatable")
      ->type_name("TISSUE=LENGTH")
      ->expected(1)
      ->take_all();
  app.add_option(
         "--target-tets", meshing.targetTets,
         "choose the edge length of each tissue without a --size for so many tets, within 10 %; 0: off")
      ->check(CommandLine::atLeast(0))
      ->capture_default_str()
      ->excludes(edgeLength);
  app.add_option("--curvature", meshing.curvature,
                 "refine where cube size times curvature exceeds this; 0: nowhere, nor thin parts")
      ->check(CommandLine::atLeast(0))
      ->capture_default_str();
  line.addLength("--tolerance", meshing.tolerance,
                 "refine where cube size^2 times curvature / 8 exceeds this; 0: nowhere");
  app.add_option("--levels", meshing.levels,
                 "largest number of lattice levels; 0: as many as the sizes ask for")
      ->check(CommandLine::atLeast(0))
      ->capture_default_str();
  line.addSmoothing("--smoothing", meshing.smoothing);
  app.add_option("--smooth", command.smoothings, "smoothing of one tissue; repeatable")
      ->type_name("TISSUE=HOW")
      ->expected(1)
      ->take_all();
  app.add_option("--method", command.method, "how the mesh is fitted to the surface")
      ->check(CLI::IsMember({"optimization"}))
      ->capture_default_str();
  app.add_flag("--preserve-volume", meshing.preserveVolume,
               "keep the volume of the level set within 0.1 % instead of 0.5 %");
  app.add_flag("--with-quality", meshing.withQuality,
               "write the arrays aspect_ratio, min_dihedral_deg, max_dihedral_deg and phi to the meshes");
  app.footer(
      "Lengths are mm, or voxels with the suffix vox: 1vox is the cube root of the voxel volume.\n"
      "Exit code 0: every tissue is meshed or too small for the lattice; 1: failed, or a tissue failed.");
}

/// TISSUE=VALUE pairs of a repeatable option.
template <typename Value>
std::map<std::string, Value> parsePairs(const std::string& option, const std::string& form,
                                        const std::vector<std::string>& texts,
                                        Value (*parse)(std::string_view)) {
  std::map<std::string, Value> values;
  for (const std::string& text : texts) {
    const auto equals = text.rfind('=');
    if (equals == text.npos || equals == 0)
      throw CLI::ValidationError(option, "'" + text + "' is not " + form);
    try {
      values[text.substr(0, equals)] = parse(text.substr(equals + 1));
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(option, error.what());
    }
  }
  return values;
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

/// What `main` says when tissues failed: their names, as far as they fit in a line.
std::string failureSummary(const std::vector<TissueReport>& reports) {
  constexpr int kNamed = 5;
  std::string names;
  int count = 0;
  for (const TissueReport& report : reports) {
    if (report.status != TissueStatus::Failed) continue;
    if (++count <= kNamed) names += (names.empty() ? "" : ", ") + printable(report.name);
  }
  return std::to_string(count) + " of " + std::to_string(reports.size()) + " tissues failed: " + names +
         (count > kNamed ? ", ..." : "");
}

std::vector<TissueReport> meshWithProgress(const CommandLine& line, const MeshCommand& command,
                                           const Segmentation& segmentation,
                                           const std::vector<int>& tissues) {
  ProgressDisplay display(line.common);
  return meshTissues(segmentation, tissues, command.folder, command.meshing,
                     [&](const std::string& tissue, const std::string& stage, double done) {
                       checkInterrupt();
                       display.show(tissue, stage, done);
                     });
}

int mesh(const CommandLine& line, MeshCommand& command) {
  const auto start = std::chrono::steady_clock::now();
  command.meshing.sizes = parsePairs("--size", "TISSUE=LENGTH", command.sizes, &parseLength);
  command.meshing.smoothings = parsePairs("--smooth", "TISSUE=HOW", command.smoothings, &parseSmoothing);
  checkOutputFolder(command.folder, {kReportName}, line.common.force);
  const Segmentation segmentation = readSegmentation(command.input, command.reading);
  const std::vector<int> tissues = selectTissues(segmentation, command.wishes);
  const std::vector<std::string> stems = tissueFileStems(segmentation.tissues);
  std::vector<std::string> files{kReportName};
  for (const int tissue : tissues) files.push_back(stems[tissue] + ".vtu");
  checkOutputFolder(command.folder, files, line.common.force);

  const InterruptScope interruptible;
  const OutputFolder folder(command.folder);
  MeshingReport run;
  run.input = command.input;
  run.wishes = command.wishes;
  run.voxel = segmentation.geometry.meanSpacing();
  run.options = command.meshing;
  run.threads = threadCount();
  run.tissues = meshWithProgress(line, command, segmentation, tissues);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.peakMemory = peakMemory();

  const std::string document = toJson(run);
  const std::filesystem::path reportFile = std::filesystem::path(command.folder) / kReportName;
  writeTextFile(reportFile, document);
  line.writeJson(document);
  if (std::ostream* stream = line.tables()) printResult(*stream, run, reportFile);
  if (countOf(TissueStatus::Failed, run.tissues) > 0) throw std::runtime_error(failureSummary(run.tissues));
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
