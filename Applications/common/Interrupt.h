#pragma once

namespace sinew {

/// Thrown by checkInterrupt.
struct Interrupted {};

inline constexpr int kInterruptedExitCode = 130;

/// From now on SIGINT and SIGTERM end the process with exit code 130, without partial files.
void installInterruptHandler();

/// While one of these lives, the first signal only makes checkInterrupt throw, so that what was begun can be
/// taken back; a second one ends the process at once, as ever without partial files.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;
};

/// @throws Interrupted when a signal has come.
void checkInterrupt();

}  // namespace sinew
