#include "sinew/Pipeline/StagedFolder.h"

#include <stdexcept>
#include <unistd.h>

namespace sinew {

namespace fs = std::filesystem;

StagedFolder::StagedFolder(const fs::path& target)
    : folder_(target), target_(target), temporary_(target / (".partial-" + std::to_string(getpid()))) {
  std::error_code error;
  fs::create_directory(temporary_, error);
  if (error) throw std::runtime_error(target_.string() + ": cannot be written: " + error.message());
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void StagedFolder::commit() {
  for (const auto& entry : fs::directory_iterator(temporary_)) {
    const fs::path place = target_ / entry.path().filename();
    std::error_code error;
    fs::rename(entry.path(), place, error);
    if (error) throw std::runtime_error(place.string() + ": cannot be written: " + error.message());
  }
}

}  // namespace sinew
