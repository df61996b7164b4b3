#include "LegalNames.h"

#include <algorithm>
#include <map>
#include <set>

namespace sinew {
namespace {

bool isControl(unsigned char c) { return c < 0x20 || c == 0x7f; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool continuesCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// The length of the UTF-8 character that starts at `at`; 0 when none does.
std::size_t characterLength(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!continuesCharacter(text[at + i])) return 0;
  return length;
}

std::string legal(std::string_view name, const NameRule& rule) {
  std::string text;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t length = characterLength(name, at);
    const bool refused = length == 0 || (length > 1 && rule.asciiOnly) ||
                         (length == 1 && (isControl(static_cast<unsigned char>(name[at])) ||
                                          rule.refused.find(name[at]) != rule.refused.npos));
    text += refused ? std::string_view("_") : name.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return rule.letterFirst && !isLetter(text.front()) ? "T_" + text : text;
}

/// Cut so that `ending` fits behind it.
std::string withEnding(std::string name, const std::string& ending, const NameRule& rule) {
  std::size_t size = std::min(name.size(), rule.maxBytes - ending.size());
  while (size < name.size() && size > 0 && continuesCharacter(name[size])) --size;
  return name.substr(0, size) + ending;
}

}  // namespace

std::vector<std::string> legalNames(const std::vector<TissueRegion>& regions, const NameRule& rule,
                                    const std::vector<std::string>& taken) {
  std::vector<std::string> whole, names;
  std::map<std::string, int> uses;
  for (const TissueRegion& region : regions) {
    whole.push_back(
        legal(region.name.empty() ? "Segment_" + std::to_string(region.label) : region.name, rule));
    names.push_back(withEnding(whole.back(), "", rule));
    ++uses[lowerCase(names.back())];
  }
  for (const std::string& name : taken) ++uses[name];
  std::set<std::string> used(taken.begin(), taken.end());
  for (const std::string& name : names)
    if (uses[lowerCase(name)] == 1) used.insert(lowerCase(name));
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (uses[lowerCase(names[r])] == 1) continue;
    std::string ending = std::string("_").append(std::to_string(regions[r].label));
    do names[r] = withEnding(whole[r], ending, rule);
    while (!used.insert(lowerCase(names[r])).second && (ending += '_', true));
  }
  return names;
}

std::string inComment(std::string_view name) {
  std::string text;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t length = characterLength(name, at);
    if (length == 0)
      text += '?';
    else if (length == 1 && isControl(static_cast<unsigned char>(name[at])))
      text += ' ';
    else
      text += name.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return text;
}

}  // namespace sinew
