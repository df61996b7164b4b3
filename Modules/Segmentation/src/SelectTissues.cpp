#include "sinew/Segmentation/SelectTissues.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace sinew {
namespace {

constexpr std::size_t kNearestNames = 3;

std::string folded(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '_' || c == '-') c = ' ';
  }
  return text;
}

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

/// How far a name is from a wish: a name that contains the wish, or the other way round, comes before the
/// rest.
std::size_t unlikeness(const std::string& wish, const std::string& name) {
  const bool contained = name.find(wish) != name.npos || (name.size() > 2 && wish.find(name) != wish.npos);
  return editDistance(wish, name) + (contained ? 0 : 1000);
}

std::string nearestNames(const Segmentation& segmentation, const std::string& wish) {
  std::vector<std::pair<std::size_t, std::string>> names;
  for (const Tissue& tissue : segmentation.tissues)
    names.emplace_back(unlikeness(folded(wish), folded(tissue.name)), tissue.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string list;
  for (std::size_t n = 0; n < std::min(kNearestNames, names.size()); ++n)
    list += (n == 0 ? "'" : ", '") + names[n].second + "'";
  return list;
}

[[noreturn]] void refuse(const Segmentation& segmentation, const std::string& wish) {
  for (const Tissue& tissue : segmentation.emptyTissues)
    if (tissue.name == wish || tissue.id == wish)
      throw std::invalid_argument(segmentation.source + ": tissue '" + wish + "' has no voxel");
  throw std::invalid_argument(segmentation.source + ": no tissue '" + wish + "'; the nearest names are " +
                              nearestNames(segmentation, wish) + "; `sinew info` lists all");
}

std::vector<int> matches(const Segmentation& segmentation, const std::string& wish) {
  std::int32_t label = 0;
  const auto parsed = std::from_chars(wish.data(), wish.data() + wish.size(), label);
  const bool isNumber = parsed.ec == std::errc() && parsed.ptr == wish.data() + wish.size();
  const std::array<std::function<bool(const Tissue&)>, 4> kinds{
      [&](const Tissue& tissue) { return tissue.name == wish; },
      [&](const Tissue& tissue) { return tissue.id == wish; },
      [&](const Tissue& tissue) { return isNumber && tissue.label == label; },
      [&](const Tissue& tissue) { return folded(tissue.name) == folded(wish); }};
  std::vector<int> found;
  for (const auto& matchesKind : kinds) {
    for (std::size_t t = 0; t < segmentation.tissues.size(); ++t)
      if (matchesKind(segmentation.tissues[t])) found.push_back(static_cast<int>(t));
    if (!found.empty()) break;
  }
  return found;
}

}  // namespace

std::vector<int> selectTissues(const Segmentation& segmentation, const std::vector<std::string>& wishes) {
  std::vector<int> all(segmentation.tissues.size());
  std::iota(all.begin(), all.end(), 0);
  if (wishes.empty()) return all;
  std::set<int> selected;
  for (const std::string& wish : wishes) {
    const std::vector<int> found = matches(segmentation, wish);
    if (found.empty()) refuse(segmentation, wish);
    selected.insert(found.begin(), found.end());
  }
  return {selected.begin(), selected.end()};
}

}  // namespace sinew
