#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew {

/// A file that appears under its name only when it is complete: write to `temporary()`, then `commit()`.
/// Until then, and on every way out without a commit, nothing stands under the name and the temporary is
/// removed.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// In the target's folder, hidden, with all of the target's extensions.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Renames, replacing an older file.
  /// @throws std::runtime_error naming the file when that fails.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int slot_;  ///< in the table of temporaries that a signal handler removes; -1: none was free
};

/// Writes a whole text file through OutputFile.
/// @throws std::runtime_error naming the file when it cannot be written.
void writeTextFile(const std::filesystem::path& file, const std::string& text);

/// Removes the temporaries of every OutputFile that is alive. For signal handlers: only async-signal-safe
/// calls; leave the process afterwards.
void removeTemporaryFiles() noexcept;

/// Checks before any computing that a file can be written: its folder, existing or still to be made, is
/// writable, and the file is not there unless `force`. Leaves nothing behind.
/// @throws std::runtime_error naming the file, what is wrong and what to do.
void checkOutputFile(const std::filesystem::path& file, bool force);

/// The same for a folder that is to receive files of these names.
void checkOutputFolder(const std::filesystem::path& folder, const std::vector<std::string>& names,
                       bool force);

/// Creates a folder and its parents, and takes back what it created when it is destroyed with the folder
/// empty.
class OutputFolder {
 public:
  /// @throws std::runtime_error naming the folder when it cannot be created.
  explicit OutputFolder(const std::filesystem::path& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::filesystem::path> created_;  ///< innermost last
};

}  // namespace sinew
