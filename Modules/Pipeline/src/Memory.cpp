#include "sinew/Pipeline/Memory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sys/resource.h>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// The number after `key` in a file of `key number` lines; infinity when there is none.
double numberAfter(const fs::path& file, const std::string& key) {
  std::ifstream stream(file);
  std::string word;
  while (stream >> word) {
    double number = 0;
    if (word == key && stream >> number) return number;
  }
  return kUnknown;
}

/// The number that is a file's whole content; infinity for `max` or no file.
double numberIn(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0;
  return stream >> number ? number : kUnknown;
}

double freeOfMachine() {
  const double kilobytes = numberAfter("/proc/meminfo", "MemAvailable:");
  return kilobytes * 1024;
}

/// What one control group leaves: its limit minus what is used and cannot be dropped.
double freeOfGroup(const fs::path& group, const char* limitName, const char* usageName,
                   const char* cacheKey) {
  const double limit = numberIn(group / limitName);
  const double usage = numberIn(group / usageName);
  if (!std::isfinite(limit) || !std::isfinite(usage)) return kUnknown;
  const double cache = numberAfter(group / "memory.stat", cacheKey);
  return std::max(0., limit - usage + (std::isfinite(cache) ? cache : 0));
}

/// The least over the group and all groups above it, up to the mount point.
double freeOfGroups(const fs::path& mount, fs::path group, const char* limit, const char* usage,
                    const char* cacheKey) {
  double least = freeOfGroup(mount, limit, usage, cacheKey);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path())
    least = std::min(least, freeOfGroup(mount / group, limit, usage, cacheKey));
  return least;
}

double freeOfControlGroups() {
  double least = kUnknown;
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {  // hierarchy:controllers:path
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == line.npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1),
                      group = line.substr(second + 1);
    if (controllers.empty())
      least = std::min(
          least, freeOfGroups("/sys/fs/cgroup", group, "memory.max", "memory.current", "inactive_file"));
    if (controllers == "memory")
      least = std::min(least, freeOfGroups("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes",
                                           "memory.usage_in_bytes", "total_inactive_file"));
  }
  return least;
}

}  // namespace

double availableMemory() { return std::min(freeOfMachine(), freeOfControlGroups()); }

double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

std::string formatBytes(double bytes) {
  constexpr std::array<const char*, 6> units{"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  char text[64];
  std::snprintf(text, sizeof text, bytes < 10 && unit > 0 ? "%.1f %s" : "%.0f %s", bytes, units[unit]);
  return text;
}

}  // namespace sinew
