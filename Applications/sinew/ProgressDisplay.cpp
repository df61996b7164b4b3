#include "ProgressDisplay.h"

#include "TextTable.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace sinew {
namespace {

constexpr std::chrono::milliseconds kBetweenFrames{100};
constexpr std::size_t kBarCells = 24;

bool hasTerminal() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

std::size_t terminalColumns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// The beginning of a text that fits in so many columns.
std::string cut(std::string text, std::size_t columns) {
  while (displayWidth(text) > columns) {
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
    if (!text.empty()) text.pop_back();
  }
  return text;
}

}  // namespace

ProgressDisplay::ProgressDisplay(const CommonOptions& options)
    : kind_(options.quiet     ? Kind::None
            : options.verbose ? Kind::Lines
            : hasTerminal()   ? Kind::Bar
                              : Kind::None) {}

ProgressDisplay::~ProgressDisplay() { clear(); }

void ProgressDisplay::clear() {
  if (std::exchange(drawn_, false)) std::cerr << "\r\033[K" << std::flush;
}

void ProgressDisplay::show(const std::string& tissue, const std::string& stage, double done) {
  if (kind_ == Kind::None) return;
  if (kind_ == Kind::Bar) return showBar(printable(tissue) + ": " + stage, done);
  if (std::exchange(stages_[tissue], stage) == stage) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  std::cerr << fixed(seconds, 1) << " s  " << fixed(100 * done, 0) << " %  " << printable(tissue) << ": "
            << stage << std::endl;
}

void ProgressDisplay::showBar(const std::string& text, double done) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kBetweenFrames;
  drawn_ = true;
  const auto full = static_cast<std::size_t>(done * kBarCells);
  const std::string percent = fixed(100 * done, 0);
  std::string line = "[" + std::string(full, '#') + std::string(kBarCells - full, '.') + "] " +
                     std::string(3 - std::min<std::size_t>(3, percent.size()), ' ') + percent + " %  " + text;
  std::cerr << "\r\033[K" << cut(line, terminalColumns() - 1) << std::flush;
}

}  // namespace sinew
