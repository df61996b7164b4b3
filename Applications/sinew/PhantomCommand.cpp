#include "CommandLine.h"
#include "Interrupt.h"
#include "TextTable.h"
#include "commands.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Pipeline/Report.h"
#include "sinew/Segmentation/LabelComponents.h"
#include "sinew/Segmentation/Phantom.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <stdexcept>

namespace sinew {
namespace {

struct PhantomCommand {
  std::string name, output;
  bool list = false;
  PhantomOptions options;
};

int listPhantoms() {
  TextTable table({{"phantom", Align::Left}, {"", Align::Left}});
  for (const PhantomInfo& phantom : phantoms()) table.add({phantom.name, phantom.description});
  table.print(std::cout);
  return 0;
}

int phantom(const CommandLine& line, const PhantomCommand& command) {
  if (command.list) return listPhantoms();
  if (command.name.empty()) throw CLI::RequiredError("NAME");
  if (command.output.empty()) throw CLI::RequiredError("--output");
  if (!command.output.ends_with(".nrrd"))
    throw CLI::ValidationError("--output", command.output + ": phantoms are written as .nrrd or .seg.nrrd");
  checkOutputFile(command.output, line.common.force);
  const Segmentation segmentation = makePhantom(command.name, command.options);
  if (segmentation.tissues.empty())
    throw std::invalid_argument(command.name + ": no voxel lies in a tissue; use a smaller --spacing");
  const OutputFolder folder(std::filesystem::absolute(command.output).parent_path());
  OutputFile output(command.output);
  writeSegmentation(segmentation, output.temporary());
  output.commit();
  std::vector<std::int64_t> pieces;
  for (const Tissue& tissue : segmentation.tissues)
    pieces.push_back(static_cast<std::int64_t>(labelComponents(segmentation, tissue).voxels.size()));
  line.writeJson(toJson(segmentation, pieces));
  if (line.common.verbose)
    std::cerr << command.output << ": " << segmentation.tissues.size() << " tissues" << std::endl;
  return 0;
}

std::string phantomNames() {
  std::string names;
  for (const PhantomInfo& phantom : phantoms()) names += (names.empty() ? "" : ", ") + phantom.name;
  return names;
}

/// One number for all axes, or three.
Eigen::Vector3d parseSpacing(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(text, ',')) {
    numbers.emplace_back();
    if (!CLI::detail::lexical_cast(part, numbers.back())) numbers.clear();
  }
  if (numbers.size() == 1) return Eigen::Vector3d::Constant(numbers[0]);
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  throw CLI::ValidationError("--spacing", "'" + text + "' is neither one number nor three: X or X,Y,Z");
}

}  // namespace

int runPhantom(const std::vector<std::string>& arguments) {
  CommandLine line("phantom", "Writes an analytic labelled volume, as a Slicer segmentation.");
  PhantomCommand command;
  CLI::App& app = line.app;
  app.add_option("NAME", command.name, phantomNames());
  app.add_option("-o,--output", command.output, "file to write: .nrrd or .seg.nrrd")->type_name("FILE");
  app.add_flag("--list", command.list, "describe the phantoms");
  app.add_option_function<std::string>(
         "--spacing", [&](const std::string& text) { command.options.spacing = parseSpacing(text); },
         "voxel spacing, mm; default the phantom's own")
      ->type_name("X[,Y,Z]");
  app.add_option("--tilt-deg", command.options.tiltDeg,
                 "turn of the scan axes about an oblique axis, degrees; default the phantom's own");
  app.add_option("--noise", command.options.noise, "fraction of surface voxels flipped at random, in [0, 1]")
      ->capture_default_str();
  app.add_option("--seed", command.options.seed, "seed of the noise")->capture_default_str();
  return line.run(arguments, [&] { return phantom(line, command); });
}

}  // namespace sinew
