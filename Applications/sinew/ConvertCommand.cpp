#include "ConvertCommand.h"

#include "FileKind.h"
#include "MeshSettings.h"
#include "commands.h"

#include <stdexcept>

namespace sinew {
namespace {

/// An option, and of which kind of inputs it is.
struct ConvertOption {
  FileKind kind;
  Option option;
};

const char* inputsOf(FileKind kind) { return kind == FileKind::Mesh ? "meshes" : "segmentations"; }

std::vector<ConvertOption> convertOptions(ConvertCommand& command) {
  using enum FileKind;
  std::vector<ConvertOption> options{
      {Segmentation, lutOption(command.reading)},
      {Segmentation, {"--tissue", &command.tissues, "keep only this tissue; default all", "NAME|LABEL"}},
      {Segmentation,
       {.flags = "--overlap",
        .target = &command.overlap,
        .help = "where tissues overlap, and the file holds one label per voxel: refuse, or the first of the "
                "table keeps the voxel",
        .choices = {"refuse", "first"}}},
      {Segmentation,
       {"--priority", &command.priority,
        "this tissue keeps its voxels where tissues overlap, the first one first", "NAME"}},
      {Segmentation, fractionalOption(command.reading)},
      {Segmentation,
       {"--table", &command.tables,
        "write names and colours as .ctbl, .csv or .tsv; default beside a label map: OUT.ctbl, for *_dseg "
        "OUT.tsv",
        "FILE"}},
      {Segmentation, {"--no-table", &command.noTable, "no table beside a label map"}},
  };
  for (const Option& option : meshFileOptions(command.files)) options.push_back({Mesh, option});
  return options;
}

void addOptions(CommandLine& line, ConvertCommand& command, std::vector<std::string>& files) {
  line.app.add_option("INPUT... OUT", files, "a segmentation, or meshes; then the file to write")
      ->type_name("FILE")
      ->required();
  for (const ConvertOption& row : convertOptions(command))
    addOption(line.app, row.option)
        ->group(row.kind == FileKind::Mesh
                    ? "Meshes"
                    : "Segmentations (.seg.nrrd; label maps .nrrd, .nii, .nii.gz, .mha)");
}

/// @throws CLI::ValidationError for an option of the other kind
void refuseOptionsOfOthers(const CommandLine& line, ConvertCommand& command, FileKind kind) {
  for (const ConvertOption& row : convertOptions(command))
    if (row.kind != kind && line.app.get_option(row.option.flags)->count() > 0)
      throw CLI::ValidationError(row.option.flags, std::string("is for ") + inputsOf(row.kind) +
                                                       ", and the inputs are " + inputsOf(kind));
}

int convert(const CommandLine& line, ConvertCommand& command, std::vector<std::string> files) {
  if (files.size() < 2) throw CLI::RequiredError("OUT");
  command.output = files.back();
  files.pop_back();
  command.inputs = std::move(files);
  const FileKind kind = fileKind(command.inputs.front());
  for (const std::string& input : command.inputs)
    if (fileKind(input) != kind)
      throw std::runtime_error(input + ": segmentations and meshes cannot be mixed; convert them one by one");
  refuseOptionsOfOthers(line, command, kind);
  line.writeJson(kind == FileKind::Mesh ? convertMeshes(line, command) : convertSegmentation(line, command));
  return 0;
}

}  // namespace

int runConvert(const std::vector<std::string>& arguments) {
  CommandLine line("convert", "Writes a segmentation, or meshes as one, in another format.");
  ConvertCommand command;
  std::vector<std::string> files;
  addOptions(line, command, files);
  return line.run(arguments, [&] { return convert(line, command, files); });
}

}  // namespace sinew
