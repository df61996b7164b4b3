#include "sinew/Segmentation/NearestNames.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sinew {
namespace {

constexpr std::size_t kMostBytes = 200;  ///< of what was typed; no name is longer

/// Levenshtein's distance, in bytes.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

std::size_t unlikeness(const std::string& typed, const std::string& name) {
  const bool contained = name.find(typed) != name.npos || (name.size() > 2 && typed.find(name) != typed.npos);
  return editDistance(typed, name) + (contained ? 0 : 1000);
}

}  // namespace

std::string looseName(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '_' || c == '-') c = ' ';
  }
  return name;
}

std::string nearestNames(const std::string& typed, const std::vector<std::string>& names, std::size_t count) {
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& name : names)
    ranked.emplace_back(unlikeness(looseName(typed.substr(0, kMostBytes)), looseName(name)), name);
  std::sort(ranked.begin(), ranked.end());
  ranked.erase(std::unique(ranked.begin(), ranked.end()), ranked.end());
  std::string list;
  for (std::size_t n = 0; n < std::min(count, ranked.size()); ++n)
    list += (n == 0 ? "'" : ", '") + ranked[n].second + "'";
  return list;
}

}  // namespace sinew
