#include "Option.h"

#include <charconv>

namespace sinew {
namespace {

std::string shortest(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

struct DefaultText {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return std::to_string(*value); }
  std::string operator()(const std::int64_t* value) const { return std::to_string(*value); }
  std::string operator()(const double* value) const { return shortest(*value); }
  std::string operator()(const Length* value) const { return toString(*value); }
  std::string operator()(const Smoothing* value) const { return toString(*value); }
  std::string operator()(const std::string* value) const { return *value; }
  std::string operator()(const std::vector<std::string>*) const { return {}; }
  std::string operator()(const std::optional<double>*) const { return {}; }
  std::string operator()(const std::optional<std::filesystem::path>*) const { return {}; }
};

}  // namespace

std::string longName(const Option& option) {
  const auto dashes = option.flags.rfind("--");
  return dashes == option.flags.npos ? option.flags : option.flags.substr(dashes + 2);
}

std::string helpText(const Option& option, ListStyle lists) {
  if (!std::holds_alternative<std::vector<std::string>*>(option.target)) return option.help;
  return option.help + (lists == ListStyle::Commas ? "; several with commas between" : "; repeatable");
}

std::string defaultText(const Option& option) { return std::visit(DefaultText{}, option.target); }

}  // namespace sinew
