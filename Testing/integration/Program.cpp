#include "Program.h"

#include "sinew/TestSupport/Files.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;

/// In the child: takes a file as a stream of output.
void redirect(const fs::path& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(127);
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments) : Program(SINEW_PROGRAM, arguments) {}

Program::Program(const fs::path& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  writeBytes(folder_ / "err", "");
  writeBytes(folder_ / "out", "");
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("cannot fork");
  if (process_ == 0) {
    redirect(folder_ / "out", STDOUT_FILENO);
    redirect(folder_ / "err", STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
}

Program::~Program() {
  if (!reaped_) waitpid(process_, &status_, 0);
}

bool Program::ended() {
  reaped_ = reaped_ || waitpid(process_, &status_, WNOHANG) == process_;
  return reaped_;
}

bool Program::waitFor(const std::string& text) {
  while (readBytes(folder_ / "err").find(text) == std::string::npos) {
    if (ended()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

std::string Program::output() const { return readBytes(folder_ / "out"); }

void Program::signal(int number) const { kill(process_, number); }

ProgramResult Program::wait() {
  if (!reaped_) waitpid(process_, &status_, 0);
  reaped_ = true;
  return {WIFEXITED(status_) ? WEXITSTATUS(status_) : -1, readBytes(folder_ / "out"),
          readBytes(folder_ / "err")};
}

ProgramResult run(const std::vector<std::string>& arguments) { return Program(arguments).wait(); }

fs::path makePhantom(const TempFolder& folder, const std::string& name,
                     const std::vector<std::string>& options) {
  const fs::path file = folder / (name + ".seg.nrrd");
  std::vector<std::string> arguments{"phantom", name, "-o", file.string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult result = run(arguments);
  if (result.exitCode != 0) throw std::runtime_error(result.err);
  return file;
}

bool isOneErrorLine(const std::string& text) {
  return text.starts_with("sinew: ") && std::count(text.begin(), text.end(), '\n') == 1 &&
         text.ends_with('\n');
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace sinew::test
