#pragma once

#include <filesystem>
#include <iterator>
#include <string>
#include <unistd.h>

namespace sinew::test {

/// A fresh empty folder that disappears with the object. One per test: names never collide, also between
/// processes.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "sinew-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::filesystem::filesystem_error("mkdtemp", pattern, lastError());
    path_ = pattern;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  static std::error_code lastError() { return {errno, std::generic_category()}; }

  std::filesystem::path path_;
};

/// How many files and folders a folder holds.
inline std::size_t entriesOf(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator entries(folder);
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

}  // namespace sinew::test
