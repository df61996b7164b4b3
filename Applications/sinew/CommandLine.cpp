#include "CommandLine.h"

#include "Process.h"
#include "TextTable.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Pipeline/Report.h"

#include <tbb/global_control.h>

#include <iostream>

namespace sinew {
CommandLine::CommandLine(const std::string& command, const std::string& description)
    : app(description, "sinew " + command) {
  app.set_help_flag();  // it comes back with the common options, below the command's own
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.get_formatter()->column_width(32);
}

void CommandLine::addCommonOptions() {
  CLI::Option* options[]{
      app.add_option("--threads", common.threads, "threads; default all processors")->check(atLeast(1)),
      app.add_option("--json", common.json,
                     "write the machine-readable result to FILE, or to standard output for -")
          ->type_name("FILE|-"),
      app.add_flag("--quiet", common.quiet, "nothing on standard error but failures"),
      app.add_flag("--verbose", common.verbose, "a line on standard error for every step"),
      app.add_flag("--force", common.force, "replace existing outputs"),
      app.set_config("--config", "", "read options from FILE, with lines like `edge-length = 1.5`")
          ->type_name("FILE"),
      app.set_version_flag("--version", std::string("sinew ") + version(), "show the version"),
      app.set_help_flag("-h,--help", "show this help"),
  };
  for (CLI::Option* option : options) option->group("Common options");
}

int CommandLine::run(const std::vector<std::string>& arguments, const std::function<int()>& action) {
  addCommonOptions();
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes them in reverse
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ConfigError& error) {
    throw CLI::ConfigError(app.get_config_ptr()->as<std::string>() + ": " + error.what(),
                           CLI::ExitCodes::ConfigError);
  }
  if (!common.json.empty() && !common.jsonOnStdout()) checkOutputFile(common.json, common.force);
  const ThreadLimit limit(common.threads);
  return action();
}

std::ostream* CommandLine::tables() const {
  if (!common.jsonOnStdout()) return &std::cout;
  return common.quiet ? nullptr : &std::cerr;
}

void CommandLine::warn(const std::string& warning) const {
  if (!common.quiet && !warning.empty()) std::cerr << printable(warning) << std::endl;
}

void CommandLine::printWarnings(const Segmentation& segmentation) const {
  for (const std::string& warning : segmentation.warnings) warn(warning);
}

void CommandLine::writeJson(const std::string& document) const {
  if (common.jsonOnStdout())
    std::cout << document;
  else if (!common.json.empty())
    writeTextFile(common.json, document);
}

int threadCount() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace sinew
