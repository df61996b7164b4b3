#pragma once

#include "OptionParser.h"
#include "sinew/Segmentation/Segmentation.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace sinew {

/// What every sub-command understands.
struct CommonOptions {
  int threads = 0;       ///< 0: all processors
  std::string json;      ///< file of the machine-readable result, `-` for standard output, empty for none
  bool quiet = false;    ///< nothing on standard error but failures
  bool verbose = false;  ///< a line for every step
  bool force = false;    ///< replace existing outputs

  bool jsonOnStdout() const { return json == "-"; }
};

/// The command line of one sub-command: add options to `app`, then run.
class CommandLine {
 public:
  CommandLine(const std::string& command, const std::string& description);

  CLI::App app;
  CommonOptions common;

  /// Adds the common options, parses, checks the output of --json, sets the number of threads, and calls the
  /// action; or prints help or version.
  /// @throws CLI::ParseError on wrong usage, and what `action` throws
  int run(const std::vector<std::string>& arguments, const std::function<int()>& action);

  /// Where tables for people go: standard output, or standard error when that belongs to the JSON; nullptr
  /// for nowhere.
  std::ostream* tables() const;
  /// One line on standard error, unless --quiet; nothing for an empty text.
  void warn(const std::string& warning) const;
  /// What reading an input had to change, on standard error unless --quiet.
  void printWarnings(const Segmentation& segmentation) const;
  /// Writes the machine-readable result if the user wants it.
  void writeJson(const std::string& document) const;

 private:
  void addCommonOptions();
};

/// Threads as resolved by CommandLine::run.
int threadCount();

}  // namespace sinew
