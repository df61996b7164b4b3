#pragma once

#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sinew::fuzz {

/// A broken law ends the fuzzer, and fails the test of the corpus.
inline void require(bool holds, const std::string& law) {
  if (!holds) throw std::logic_error(law);
}

/// Where the inputs of this process lie, each replacing the one before; in memory when TMPDIR says so.
inline const test::TempFolder& folder() {
  static const test::TempFolder folder;
  return folder;
}

/// Lets `read` take the bytes from a file of this name. It returns a value, or refuses them by one line that
/// begins with the file.
template <class Read>
auto readAs(std::string_view name, std::string_view bytes, Read read)
    -> std::optional<decltype(read(std::filesystem::path()))> {
  const std::filesystem::path file = folder() / name;
  test::writeBytes(file, std::string(bytes));
  try {
    return read(file);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    require(message.starts_with(file.string() + ": "), "a message does not name the file: " + message);
    require(message.find('\n') == message.npos, "a message has more than one line: " + message);
    return std::nullopt;
  }
}

}  // namespace sinew::fuzz
