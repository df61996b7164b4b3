#include "Interrupt.h"
#include "Process.h"
#include "commands.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <new>
#include <string>

namespace {

constexpr int kFailed = 1, kWrongUsage = 2;

/// The one line that every failure prints.
int fail(const std::string& reason, int exitCode) {
  std::cout.flush();
  std::cerr << "sinew: " << sinew::asOneLine(reason) << std::endl;
  return exitCode;
}

}  // namespace

int main(int argc, char** argv) {
  sinew::keepFreedMemory();
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
