#include "sinew/Pipeline/OutputFile.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace fs = std::filesystem;

namespace sinew {
namespace {

// Whoever takes a pointer out of its slot owns it: the destructor frees it, the signal handler unlinks it.
constexpr int kSlots = 256;
std::array<std::atomic<char*>, kSlots> temporaries{};

int enterTemporary(const fs::path& file) {
  char* name = strdup(file.c_str());
  for (int slot = 0; slot < kSlots; ++slot) {
    char* empty = nullptr;
    if (temporaries[slot].compare_exchange_strong(empty, name)) return slot;
  }
  std::free(name);
  return -1;
}

void leaveTemporary(int slot) {
  if (slot >= 0) std::free(temporaries[slot].exchange(nullptr));
}

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The folder itself, or the nearest one above it that exists.
fs::path existingAncestor(fs::path folder) {
  std::error_code ignored;
  while (!fs::exists(folder, ignored)) {
    const fs::path parent = folderOf(folder);
    if (parent == folder) break;
    folder = parent;
  }
  return folder;
}

/// Tries it out: what the permissions say is not the whole truth (read-only file systems, root).
void checkWritable(const fs::path& folder) {
  const fs::path ancestor = existingAncestor(folder.empty() ? fs::path(".") : folder);
  if (!fs::is_directory(ancestor)) refuse(ancestor, "is not a folder; choose another output");
  const OutputFile probe(ancestor / "probe");
  const int descriptor = open(probe.temporary().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0)
    refuse(ancestor,
           "the folder is not writable (" + std::string(std::strerror(errno)) + "); choose another output");
  close(descriptor);
}

}  // namespace

OutputFile::OutputFile(fs::path target)
    : target_(std::move(target)),
      temporary_(target_.parent_path() /
                 (".partial-" + std::to_string(getpid()) + "-" + target_.filename().string())),
      slot_(enterTemporary(temporary_)) {}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
  leaveTemporary(slot_);
}

void OutputFile::commit() {
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) refuse(target_, "cannot be written: " + error.message());
  temporary_.clear();
}

void writeTextFile(const fs::path& file, const std::string& text) {
  OutputFile output(file);
  std::ofstream stream(output.temporary(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) refuse(file, std::string("cannot be written: ") + std::strerror(errno));
  output.commit();
}

void removeTemporaryFiles() noexcept {
  for (auto& slot : temporaries)
    if (const char* name = slot.exchange(nullptr)) unlink(name);
}

void checkOutputFile(const fs::path& file, bool force) {
  if (fs::is_directory(file)) refuse(file, "is a folder; give a file name");
  if (fs::exists(file) && !fs::is_regular_file(file)) refuse(file, "is no ordinary file; give another name");
  checkOutputFolder(folderOf(file), {file.filename().string()}, force);
}

void checkOutputFolder(const fs::path& folder, const std::vector<std::string>& names, bool force) {
  checkWritable(folder);
  if (force) return;
  const auto exists = [&](const std::string& name) { return fs::exists(fs::symlink_status(folder / name)); };
  const auto count = std::count_if(names.begin(), names.end(), exists);
  if (count == 0) return;
  const fs::path first = folder / *std::find_if(names.begin(), names.end(), exists);
  const std::string others = count > 1 ? " (and " + std::to_string(count - 1) + " more outputs)" : "";
  refuse(first, "exists" + others + "; choose another output or give --force");
}

OutputFolder::OutputFolder(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::absolute(folder, error).lexically_normal();
  fs::path path;
  for (const fs::path& part : whole) {
    path /= part;
    if (part.empty()) continue;
    if (fs::create_directory(path, error))
      created_.push_back(path);
    else if (!fs::is_directory(path))
      refuse(path, "cannot be created: " + error.message());
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  // remove() refuses a folder that holds anything.
  for (auto folder = created_.rbegin(); folder != created_.rend(); ++folder) fs::remove(*folder, ignored);
}

}  // namespace sinew
