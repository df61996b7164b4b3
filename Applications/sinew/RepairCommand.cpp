#include "CommandLine.h"
#include "Interrupt.h"
#include "ProgressDisplay.h"
#include "RepairReport.h"
#include "TextTable.h"
#include "commands.h"
#include "sinew/LevelSet/LevelSetFromField.h"
#include "sinew/LevelSet/VdbFile.h"
#include "sinew/Pipeline/FileNames.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestScript = 16 << 20;  // bytes

struct RepairCommand {
  std::string input, script, output, vdbFolder;
  std::vector<std::string> settings;
  Length grid = 0;
  Smoothing smoothing;
  ReadSegmentationOptions reading;
  RepairOptions options;
};

void addOptions(CommandLine& line, RepairCommand& command) {
  CLI::App& app = line.app;
  app.add_option("INPUT", command.input, "segmentation: .nrrd, .seg.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd")
      ->required();
  app.add_option("SCRIPT", command.script, "repair script, .lua; may also come first")->required();
  app.add_option("-o,--output", command.output, "segmentation to write: .seg.nrrd or .nrrd")
      ->type_name("FILE");
  app.add_flag("--check", command.options.check, "only try the script: names and arguments, no level sets");
  app.add_option("--set", command.settings, "a global of the script; repeatable")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  app.add_option("--vdb", command.vdbFolder, "folder for the level set of each saved tissue, <tissue>.vdb")
      ->type_name("DIR");
  line.addLength(
      "--grid", command.grid,
      "spacing of the level sets; 0: the smallest spacing of the image, but not below half a voxel");
  line.addSmoothing("--smoothing", command.smoothing);
  app.add_option("--lut", command.reading.lut, "colour table with the names of the labels")
      ->type_name("FILE");
}

std::map<std::string, std::string> parseSettings(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> settings;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == text.npos || equals == 0)
      throw CLI::ValidationError("--set", "'" + text + "' is not NAME=VALUE");
    settings[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return settings;
}

std::string readScript(const std::string& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) throw std::runtime_error(file + ": there is no such script");
  if (fs::file_size(file, error) > kLargestScript)
    throw std::runtime_error(file + ": larger than 16 MB; this is no repair script");
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.eof() && stream.fail()) throw std::runtime_error(file + ": cannot be read");
  return text;
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
  if (isScript(command.input) && !isScript(command.script)) std::swap(command.input, command.script);
  command.options.settings = parseSettings(command.settings);
  if (command.options.check) return;
  if (command.output.empty()) throw CLI::RequiredError("--output");
  if (!command.output.ends_with(".nrrd"))
    throw CLI::ValidationError("--output",
                               command.output + ": segmentations are written as .seg.nrrd or .nrrd");
  checkOutputFile(command.output, line.common.force);
  if (!command.vdbFolder.empty()) checkVdbFolder(command.vdbFolder, line.common.force);
}

RepairResult repaired(const CommandLine& line, const RepairCommand& command, const Segmentation& input,
                      const std::string& script) {
  RepairOptions options = command.options;
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
  const std::string script = readScript(command.script);
  const Segmentation input = readSegmentation(command.input, command.reading);
  command.options.scriptName = command.script;
  command.options.meshFolder = fs::path(command.script).parent_path();
  const double voxel = input.geometry.meanSpacing();
  command.options.gridSpacing = command.grid.millimetres(voxel);
  command.options.smoothingVoxels = command.smoothing.kind == Smoothing::Kind::None ? 0 : 1;
  command.options.smoothingTime = command.smoothing.motion(voxel);
  command.options.levelSets = !command.vdbFolder.empty();

  const InterruptScope interruptible;
  const RepairResult result = repaired(line, command, input, script);
  if (!command.options.check) writeOutputs(command, result);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const RepairRun run{command.input, command.script, command.output, command.options.check, time.count()};
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
