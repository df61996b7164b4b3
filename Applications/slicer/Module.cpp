#include "Module.h"

#include "Interrupt.h"
#include "OptionParser.h"
#include "Process.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Pipeline/Report.h"

#include <iostream>
#include <new>

namespace sinew {
namespace {

constexpr int kFailed = 1, kWrongUsage = 2;

/// What Slicer and its GenerateCLP give to any module, beside the module's own options.
struct ContractFlags {
  std::string processInformationAddress, serialize, deserialize, returnParameterFile;
  bool xml = false, logo = false, echo = false;
};

void addContract(CLI::App& app, ContractFlags& flags) {
  CLI::Option* options[]{
      app.add_flag("--xml", flags.xml, "print the description of the module"),
      app.add_option("--returnparameterfile", flags.returnParameterFile, "file for the results"),
      app.add_option("--processinformationaddress", flags.processInformationAddress, "ignored"),
      app.add_flag("--echo", flags.echo, "ignored"),
      app.add_flag("--logo", flags.logo, "ignored"),
      app.add_option("--serialize", flags.serialize, "ignored"),
      app.add_option("--deserialize", flags.deserialize, "ignored"),
      app.set_version_flag("--version", std::string("sinew ") + version(), "show the version"),
  };
  for (CLI::Option* option : options) option->group("Of every Slicer module");
}

void addParameters(CLI::App& app, const ModuleDescription& description) {
  for (const ModuleGroup& group : description.groups)
    for (const ModuleParameter& parameter : group.parameters) {
      if (parameter.result()) continue;
      CLI::Option* option = addOption(app, parameter.option, ListStyle::Commas);
      if (parameter.positional()) option->required();
    }
}

/// `name = value`, one line for each result.
std::string results(const ModuleDescription& description) {
  std::string text;
  for (const ModuleGroup& group : description.groups)
    for (const ModuleParameter& parameter : group.parameters)
      if (parameter.result()) text += parameter.name() + " = " + defaultText(parameter.option) + "\n";
  return text;
}

int run(CLI::App& app, int argc, char** argv, const ModuleDescription& description,
        const std::function<void(ModuleProgress&)>& action) {
  ContractFlags flags;
  addContract(app, flags);
  addParameters(app, description);
  // Slicer asks every program in the folder, so this comes before anything that may fail.
  for (int i = 1; i < argc; ++i)
    if (std::string_view(argv[i]) == "--xml") {
      std::cout << toXml(description) << std::flush;
      return 0;
    }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  }
  ModuleProgress progress(description.program);
  action(progress);
  if (!flags.returnParameterFile.empty()) writeTextFile(flags.returnParameterFile, results(description));
  progress.finish();
  return 0;
}

int fail(const std::string& program, const std::string& reason, int exitCode) {
  std::cerr << program << ": " << asOneLine(reason) << std::endl;
  return exitCode;
}

}  // namespace

int runModule(int argc, char** argv, const ModuleDescription& description,
              const std::function<void(ModuleProgress&)>& action) {
  keepFreedMemory();
  installInterruptHandler();
  CLI::App app(description.description, description.program);
  try {
    return run(app, argc, argv, description, action);
  } catch (const CLI::ParseError& error) {
    return fail(description.program, error.what(), kWrongUsage);
  } catch (const Interrupted&) {
    return fail(description.program, "interrupted; no partial file is left", kInterruptedExitCode);
  } catch (const std::bad_alloc&) {
    return fail(description.program, "out of memory", kFailed);
  } catch (const std::exception& error) {
    return fail(description.program, error.what(), kFailed);
  }
}

}  // namespace sinew
