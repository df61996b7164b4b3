#pragma once

#include "sinew/Pipeline/OutputFile.h"

namespace sinew {

/// Files that appear in a folder only when all are complete: write to `temporary()`, then `commit()`. Until
/// then, and on every way out without a commit, none stands under its name and the temporaries are removed.
class StagedFolder {
 public:
  /// Makes the folder if it is missing, and a hidden one in it.
  /// @throws std::runtime_error naming the folder when it cannot be created
  explicit StagedFolder(const std::filesystem::path& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Moves every file to its place, replacing older ones.
  /// @throws std::runtime_error naming the file when that fails
  void commit();

 private:
  OutputFolder folder_;
  std::filesystem::path target_, temporary_;
};

}  // namespace sinew
