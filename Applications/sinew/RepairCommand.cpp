#include "CommandLine.h"
#include "Interrupt.h"
#include "MeshSettings.h"
#include "ProgressDisplay.h"
#include "RepairReport.h"
#include "RepairSettings.h"
#include "TextTable.h"
#include "commands.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/VdbFile.h"
#include "sinew/Pipeline/FileNames.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <chrono>
#include <iostream>

namespace sinew {
namespace {

namespace fs = std::filesystem;

struct RepairCommand {
  std::string input, output, vdbFolder;
  bool check = false;
  RepairSettings settings;
};

void addOptions(CommandLine& line, RepairCommand& command) {
  CLI::App& app = line.app;
  app.add_option("INPUT", command.input,
                 "segmentation: .nrrd, .seg.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd, DICOM SEG")
      ->required();
  app.add_option("SCRIPT", command.settings.script, "repair script, .lua; may also come first")->required();
  app.add_option("-o,--output", command.output, "segmentation to write: .seg.nrrd or .nrrd")
      ->type_name("FILE");
  app.add_flag("--check", command.check, "only try the script: names and arguments, no level sets");
  app.add_option("--vdb", command.vdbFolder, "folder for the level set of each saved tissue, <tissue>.vdb")
      ->type_name("DIR");
  addOptions(app, repairOptions(command.settings));
  addOption(app, fractionalOption(command.settings.reading));
}

bool isScript(const std::string& file) { return file.ends_with(".lua"); }

/// Which level sets there will be is known only when the script has run.
void checkVdbFolder(const fs::path& folder, bool force) {
  checkOutputFolder(folder, {}, force);
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".vdb") checkOutputFile(entry.path(), force);
}

/// Everything that can be wrong without reading the input.
void checkCommand(const CommandLine& line, RepairCommand& command) {
  std::string& script = command.settings.script;
  if (isScript(command.input) && !isScript(script)) std::swap(command.input, script);
  if (command.check) return;
  if (command.output.empty()) throw CLI::RequiredError("--output");
  if (!command.output.ends_with(".nrrd"))
    throw CLI::ValidationError("--output",
                               command.output + ": segmentations are written as .seg.nrrd or .nrrd");
  checkOutputFile(command.output, line.common.force);
  if (!command.vdbFolder.empty()) checkVdbFolder(command.vdbFolder, line.common.force);
}

RepairResult repaired(const CommandLine& line, const RepairCommand& command, const Segmentation& input,
                      const std::string& script) {
  RepairOptions options = resolved(command.settings, input);
  options.check = command.check;
  options.levelSets = !command.vdbFolder.empty();
  ProgressDisplay display(line.common);
  options.progress = [&](int at, const std::string& operation, double done) {
    checkInterrupt();
    display.show("line " + std::to_string(at), operation, done);
  };
  if (std::ostream* stream = line.tables())
    options.print = [&display, stream](const std::string& text) {
      display.clear();
      *stream << printable(text) << std::endl;
    };
  return repairSegmentation(input, script, options);
}

/// The level sets of the saved tissues, each in a file of its tissue's name.
void writeLevelSets(const RepairResult& result, const fs::path& folder) {
  std::vector<Tissue> tissues(result.saved.size());
  for (std::size_t n = 0; n < tissues.size(); ++n) {
    tissues[n].name = result.saved[n].name;
    tissues[n].label = result.saved[n].label;
  }
  const std::vector<std::string> stems = tissueFileStems(tissues);
  const OutputFolder made(folder);
  for (std::size_t n = 0; n < stems.size(); ++n) {
    OutputFile output(folder / (stems[n] + ".vdb"));
    writeVdb(levelSetFromField(*result.saved[n].levelSet), result.saved[n].name, output.temporary());
    output.commit();
  }
}

void writeOutputs(const RepairCommand& command, const RepairResult& result) {
  const OutputFolder folder(fs::absolute(command.output).parent_path());
  OutputFile output(command.output);
  writeSegmentation(result.segmentation, output.temporary());
  if (!command.vdbFolder.empty()) writeLevelSets(result, command.vdbFolder);
  output.commit();
}

int repair(const CommandLine& line, RepairCommand& command) {
  const auto start = std::chrono::steady_clock::now();
  checkCommand(line, command);
  const std::string script = readScript(command.settings.script);
  const Segmentation input = readSegmentation(command.input, command.settings.reading);
  line.printWarnings(input);

  const InterruptScope interruptible;
  const RepairResult result = repaired(line, command, input, script);
  if (!command.check) writeOutputs(command, result);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const RepairRun run{command.input, command.settings.script, command.output, command.check, time.count()};
  line.writeJson(toJson(run, result));
  if (std::ostream* stream = line.tables()) printResult(*stream, run, result);
  return 0;
}

}  // namespace

int runRepair(const std::vector<std::string>& arguments) {
  CommandLine line("repair", "Changes the tissues of a segmentation by a script.");
  RepairCommand command;
  addOptions(line, command);
  line.app.footer(
      "Lengths are mm, or voxels with the suffix vox: 1vox is the cube root of the voxel volume.\n"
      "The README describes the language of the scripts.");
  return line.run(arguments, [&] { return repair(line, command); });
}

}  // namespace sinew
