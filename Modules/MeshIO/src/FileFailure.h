#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace sinew {

[[noreturn]] inline void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

inline void requireReadable(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) fail(file, "no such file");
  if (!std::filesystem::is_regular_file(file) || !std::ifstream(file)) fail(file, "cannot be read");
}

}  // namespace sinew
