#include "sinew/Pipeline/FileNames.h"

#include <algorithm>
#include <array>
#include <locale.h>
#include <map>
#include <set>
#include <string_view>
#include <wctype.h>

namespace sinew {
namespace {

constexpr std::size_t kMaxStemBytes =
    180;  // file systems allow 255; room for suffixes and the temporary's prefix
constexpr std::string_view kRefused = " /\\:*?\"<>|";
constexpr std::array<std::string_view, 4> kDevices{"con", "prn", "aux", "nul"};
constexpr std::array<std::string_view, 2> kNumberedDevices{"com", "lpt"};

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool continuesCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Bytes of the UTF-8 character that starts at `at`; 0 when it is damaged.
std::size_t characterLength(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!continuesCharacter(text[at + i])) return 0;
  return length;
}

/// The character of a length that characterLength found.
char32_t characterAt(std::string_view text, std::size_t at, std::size_t length) {
  constexpr std::array<unsigned, 5> kLeadBits{0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t character = static_cast<unsigned char>(text[at]) & kLeadBits[length];
  for (std::size_t i = 1; i < length; ++i)
    character = character << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3F);
  return character;
}

/// What two stems share that a file system without regard to case takes for one.
std::u32string withoutCase(const std::string& stem) {
  static const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  std::u32string key;
  for (std::size_t at = 0, length = 0; at < stem.size(); at += length) {
    length = characterLength(stem, at);
    const char32_t character = characterAt(stem, at, length);
    key +=
        utf8 != nullptr ? static_cast<char32_t>(towlower_l(static_cast<wint_t>(character), utf8)) : character;
  }
  return key;
}

bool reserved(const std::string& stem) {
  const std::string name = lowerCase(stem.substr(0, stem.find('.')));
  if (std::find(kDevices.begin(), kDevices.end(), name) != kDevices.end()) return true;
  return name.size() == 4 && name[3] >= '0' && name[3] <= '9' &&
         std::find(kNumberedDevices.begin(), kNumberedDevices.end(), name.substr(0, 3)) !=
             kNumberedDevices.end();
}

std::string sanitized(std::string_view name) {
  std::string stem;
  for (std::size_t at = 0; at < name.size() && stem.size() < kMaxStemBytes;) {
    const std::size_t length = characterLength(name, at);
    const bool plain =
        length == 1 && (name[at] < ' ' || name[at] == 0x7f || kRefused.find(name[at]) != kRefused.npos);
    if (length == 0 || plain)
      stem += '_';
    else
      stem += name.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  if (!stem.empty() && (stem.front() == '.' || stem.front() == '-')) stem.front() = '_';
  if (!stem.empty() && stem.back() == '.') stem.back() = '_';
  if (stem.empty() || reserved(stem)) stem += "_tissue";
  return stem;
}

}  // namespace

std::vector<std::string> tissueFileStems(const std::vector<Tissue>& tissues) {
  std::vector<std::string> stems;
  std::map<std::u32string, int> sameName;
  std::map<std::pair<std::u32string, std::int32_t>, int> sameNameAndLabel;
  for (const Tissue& tissue : tissues) {
    stems.push_back(sanitized(tissue.name));
    const std::u32string key = withoutCase(stems.back());
    ++sameName[key];
    ++sameNameAndLabel[{key, tissue.label}];
  }
  std::set<std::u32string> used;
  for (std::size_t t = 0; t < tissues.size(); ++t)
    if (sameName[withoutCase(stems[t])] == 1) used.insert(withoutCase(stems[t]));
  for (std::size_t t = 0; t < tissues.size(); ++t) {
    const std::u32string key = withoutCase(stems[t]);
    if (sameName[key] == 1) continue;
    stems[t].append("_").append(std::to_string(tissues[t].label));
    if (sameNameAndLabel[{key, tissues[t].label}] > 1)
      stems[t].append("_layer").append(std::to_string(tissues[t].layer));
    while (!used.insert(withoutCase(stems[t])).second) stems[t] += "_";
  }
  return stems;
}

std::string freeFileStem(std::string wanted, const std::vector<std::string>& stems) {
  const auto taken = [&](const std::string& stem) { return lowerCase(stem) == lowerCase(wanted); };
  while (std::any_of(stems.begin(), stems.end(), taken)) wanted += "_";
  return wanted;
}

}  // namespace sinew
