#include "sinew/Pipeline/Length.h"

#include <charconv>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace sinew {

Length parseLength(std::string_view text) {
  Length length;
  const auto [unit, error] = std::from_chars(text.data(), text.data() + text.size(), length.value);
  const std::string_view suffix(unit, static_cast<std::size_t>(text.data() + text.size() - unit));
  const bool known = suffix.empty() || suffix == "mm" || suffix == "vox";
  if (error != std::errc() || !std::isfinite(length.value) || !known)
    throw std::invalid_argument("'" + std::string(text) + "' is no length: write 1.5 or 1.5mm or 2vox");
  length.inVoxels = suffix == "vox";
  return length;
}

std::string toString(Length length) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, length.value).ptr;
  return std::string(digits, end) + (length.inVoxels ? "vox" : "mm");
}

std::ostream& operator<<(std::ostream& stream, Length length) { return stream << toString(length); }

}  // namespace sinew
