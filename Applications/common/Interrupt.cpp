#include "Interrupt.h"

#include "sinew/Pipeline/OutputFile.h"

#include <atomic>
#include <csignal>
#include <string_view>
#include <unistd.h>

namespace sinew {
namespace {

std::atomic<bool> interrupted{false};
std::atomic<bool> gracefully{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers need it");

void onSignal(int) {
  if (gracefully && !interrupted.exchange(true)) return;
  removeTemporaryFiles();
  constexpr std::string_view kMessage = "sinew: interrupted; no partial file is left\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(kInterruptedExitCode);
}

}  // namespace

void installInterruptHandler() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

InterruptScope::InterruptScope() { gracefully = true; }
InterruptScope::~InterruptScope() { gracefully = false; }

void checkInterrupt() {
  if (interrupted) throw Interrupted{};
}

}  // namespace sinew
