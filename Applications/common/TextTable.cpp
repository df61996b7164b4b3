#include "TextTable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <unistd.h>

namespace sinew {
namespace {

bool wantsColour(const std::ostream& stream) {
  const char* noColour = std::getenv("NO_COLOR");
  if (noColour != nullptr && *noColour != '\0') return false;
  const char* terminal = std::getenv("TERM");
  if (terminal != nullptr && std::string_view(terminal) == "dumb") return false;
  return isatty(&stream == &std::cout ? STDOUT_FILENO : STDERR_FILENO) == 1;
}

const char* colourOf(Tone tone) {
  switch (tone) {
    case Tone::Good:
      return "\033[32m";
    case Tone::Warning:
      return "\033[33m";
    case Tone::Bad:
      return "\033[31m";
    case Tone::Plain:
      break;
  }
  return "";
}

bool combining(char32_t c) { return (c >= 0x300 && c < 0x370) || (c >= 0x200b && c < 0x2010) || c == 0xfeff; }
bool wide(char32_t c) {
  return (c >= 0x1100 && c < 0x1160) || (c >= 0x2e80 && c < 0xa4d0) || (c >= 0xac00 && c < 0xd7a4) ||
         (c >= 0xf900 && c < 0xfb00) || (c >= 0xfe30 && c < 0xfe70) || (c >= 0xff00 && c < 0xff61) ||
         (c >= 0x1f300 && c < 0x1f650) || (c >= 0x20000 && c < 0x30000);
}

}  // namespace

std::size_t displayWidth(const std::string& text) {
  std::size_t width = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto lead = static_cast<unsigned char>(text[at++]);
    char32_t c = lead < 0x80 ? lead : lead < 0xe0 ? lead & 0x1f : lead < 0xf0 ? lead & 0x0f : lead & 0x07;
    for (; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80; ++at)
      c = c << 6 | (static_cast<unsigned char>(text[at]) & 0x3f);
    width += combining(c) ? 0 : wide(c) ? 2 : 1;
  }
  return width;
}

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; }, '?');
  return text;
}

void TextTable::print(std::ostream& stream) const {
  const bool colour = wantsColour(stream);
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    widths.push_back(displayWidth(columns_[c].title));
    for (const auto& row : rows_) widths[c] = std::max(widths[c], displayWidth(printable(row[c].text)));
  }
  const auto printCell = [&](std::size_t c, const std::string& text, const char* before, const char* after) {
    const std::string padding(widths[c] - displayWidth(text), ' ');
    const bool left = columns_[c].align == Align::Left;
    const bool last = c + 1 == columns_.size();
    stream << (c > 0 ? "  " : "") << (left ? "" : padding) << before << text << after
           << (left && !last ? padding : "");
  };
  for (std::size_t c = 0; c < columns_.size(); ++c) printCell(c, columns_[c].title, "", "");
  stream << '\n';
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const bool toned = colour && row[c].tone != Tone::Plain;
      printCell(c, printable(row[c].text), toned ? colourOf(row[c].tone) : "", toned ? "\033[0m" : "");
    }
    stream << '\n';
  }
}

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string signedFixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%+.*f", decimals, value);
  return text;
}

std::string grouped(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::ptrdiff_t first = value < 0 ? 1 : 0;
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > first; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

std::string colourCode(const std::array<double, 3>& colour) {
  char text[8];
  const auto byte = [](double part) {
    return static_cast<unsigned>(std::lround(255 * std::clamp(part, 0., 1.)));
  };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(colour[0]), byte(colour[1]), byte(colour[2]));
  return text;
}

}  // namespace sinew
