#include "Interrupt.h"
#include "commands.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <limits>
#include <new>
#include <string>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

constexpr int kFailed = 1, kWrongUsage = 2;

/// The one line that every failure prints.
int fail(std::string reason, int exitCode) {
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  for (char& c : reason)
    if (c == '\n' || c == '\r') c = ' ';
  std::cout.flush();
  std::cerr << "sinew: " << reason << std::endl;
  return exitCode;
}

/// Keeps freed memory for the next stage: to give it back and to fault it in again takes up to a third of the
/// time in the kernel.
void keepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keepFreedMemory();
  sinew::installInterruptHandler();
  try {
    const int exitCode = sinew::runCommand({argv + 1, argv + argc});
    if (!std::cout.flush()) return fail("cannot write the results to standard output", kFailed);
    return exitCode;
  } catch (const CLI::ParseError& error) {
    return fail(error.what(), kWrongUsage);
  } catch (const sinew::Interrupted&) {
    return fail("interrupted; no partial file is left", sinew::kInterruptedExitCode);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}
