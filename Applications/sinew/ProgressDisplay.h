#pragma once

#include "CommandLine.h"

#include <chrono>
#include <map>
#include <string>

namespace sinew {

/// Shows how a run advances on standard error: a bar on a terminal, a line per step with --verbose, nothing
/// with
/// --quiet or elsewhere. The bar disappears with the object.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(const CommonOptions& options);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// @param done  of all work, in [0, 1]
  void show(const std::string& tissue, const std::string& stage, double done);

  /// Takes the bar away, so that something else can be printed.
  void clear();

 private:
  enum class Kind { None, Bar, Lines };
  void showBar(const std::string& text, double done);

  using Clock = std::chrono::steady_clock;
  Kind kind_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
  bool drawn_ = false;
  std::map<std::string, std::string> stages_;  ///< last stage of each tissue
};

}  // namespace sinew
