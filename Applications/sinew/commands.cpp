#include "commands.h"

#include "sinew/Pipeline/Report.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>

namespace sinew {
namespace {

struct Command {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& arguments);
};

constexpr std::array kCommands{
    Command{"mesh", "turn every tissue of a segmentation into a tetrahedral mesh", runMesh},
    Command{"repair", "change the tissues of a segmentation by a script", runRepair},
    Command{"convert", "write a segmentation, or meshes as one, in another format", runConvert},
    Command{"info", "show geometry and tissues of a segmentation", runInfo},
    Command{"quality", "measure tetrahedral meshes", runQuality},
    Command{"fibres", "give every tet of a muscle the direction of its fibres", runFibres},
    Command{"simulate", "contract, compress, dent, stretch or twist meshes, and say how they bear it",
            runSimulate},
    Command{"phantom", "write an analytic labelled volume", runPhantom},
};

void printHelp() {
  std::cout << "Segmented medical scans to one tetrahedral mesh per tissue.\n\n"
               "Usage: sinew COMMAND ...\n\nCommands:\n";
  for (const Command& command : kCommands)
    std::cout << "  " << std::left << std::setw(10) << command.name << command.summary << '\n';
  std::cout << "\n`sinew COMMAND --help` shows the options of a command; `sinew --version` the version.\n";
}

}  // namespace

int runCommand(const std::vector<std::string>& arguments) {
  if (arguments.empty())
    throw CLI::RequiredError("a command is required; `sinew --help` lists them",
                             CLI::ExitCodes::RequiredError);
  const std::string& name = arguments.front();
  if (name == "--help" || name == "-h" || name == "help") {
    printHelp();
    return 0;
  }
  if (name == "--version") {
    std::cout << "sinew " << version() << '\n';
    return 0;
  }
  const auto command = std::find_if(kCommands.begin(), kCommands.end(),
                                    [&](const Command& known) { return name == known.name; });
  if (command == kCommands.end())
    throw CLI::ExtrasError("unknown command '" + name + "'; `sinew --help` lists them",
                           CLI::ExitCodes::ExtrasError);
  return command->run({arguments.begin() + 1, arguments.end()});
}

}  // namespace sinew
