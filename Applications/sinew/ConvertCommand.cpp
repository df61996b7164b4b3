#include "ConvertCommand.h"

#include "FileKind.h"
#include "MeshSettings.h"
#include "commands.h"

#include <stdexcept>

namespace sinew {
namespace {

void addOptions(CommandLine& line, ConvertCommand& command, std::vector<std::string>& files) {
  CLI::App& app = line.app;
  app.add_option("INPUT... OUT", files, "a segmentation, or meshes; then the file to write")
      ->type_name("FILE")
      ->required();
  const std::string segmentations = "Segmentations (.seg.nrrd; label maps .nrrd, .nii, .nii.gz, .mha)";
  const std::string meshes = "Meshes";
  std::vector<Option> options{
      lutOption(command.reading),
      {"--tissue", &command.tissues, "keep only this tissue; repeatable; default all", "NAME|LABEL"},
      {.flags = "--overlap",
       .target = &command.overlap,
       .help = "where tissues overlap, and the file holds one label per voxel: refuse, or the first of the "
               "table keeps the voxel",
       .choices = {"refuse", "first"}},
      {"--priority", &command.priority,
       "this tissue keeps its voxels where tissues overlap; repeatable, the first one first", "NAME"},
      fractionalOption(command.reading),
      {"--table", &command.tables,
       "write names and colours as .ctbl, .csv or .tsv; repeatable; default beside a label map: "
       "OUT.ctbl, for *_dseg OUT.tsv",
       "FILE"},
      {"--no-table", &command.noTable, "no table beside a label map"},
  };
  for (const Option& option : options) addOption(app, option)->group(segmentations);
  for (const Option& option : meshFileOptions(command.files)) addOption(app, option)->group(meshes);
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
