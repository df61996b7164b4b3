#pragma once

#include "sinew/TestSupport/TempFolder.h"

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace sinew::test {

/// What a finished program left.
struct ProgramResult {
  int exitCode = -1;  ///< -1: ended by a signal
  std::string out, err;
};

/// A running program.
class Program {
 public:
  /// `sinew`.
  explicit Program(const std::vector<std::string>& arguments);
  Program(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  /// Waits for its end, if nobody has.
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits until its standard error holds a text. False when it ends without.
  bool waitFor(const std::string& text);
  /// What is on its standard output so far.
  std::string output() const;
  bool ended();
  void signal(int number) const;
  ProgramResult wait();

 private:
  TempFolder folder_;  ///< of the files that take its output
  pid_t process_;
  bool reaped_ = false;
  int status_ = 0;
};

/// Runs `sinew ARGUMENTS...` to its end.
ProgramResult run(const std::vector<std::string>& arguments);

/// Writes a phantom with the program; the file.
std::filesystem::path makePhantom(const TempFolder& folder, const std::string& name,
                                  const std::vector<std::string>& options = {});

/// True for one line that begins with `sinew: `.
bool isOneErrorLine(const std::string& text);

/// Names in a folder, sorted; none for a missing folder.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

}  // namespace sinew::test
