#include "ModuleDescription.h"

#include <cctype>

namespace sinew {

std::string ModuleParameter::name() const {
  std::string text;
  bool hump = false;
  for (const char c : longName(option)) {
    if (c != '-') text += hump ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    hump = c == '-';
  }
  return text;
}

std::vector<ModuleParameter> asParameters(const std::vector<Option>& options) {
  std::vector<ModuleParameter> parameters;
  for (const Option& option : options) {
    parameters.push_back({.option = option});
    if (longName(option) != "lut") continue;
    ModuleParameter& table = parameters.back();
    table.element = "table";
    table.attributes = {{"type", "color"}, {"hidden", "true"}, {"reference", kInputSegmentation}};
    table.channel = ModuleParameter::Channel::Input;
  }
  return parameters;
}

ModuleParameter inputParameter(std::string& file) {
  return {{"input-segmentation", &file, "segmentation or label map"},
          "image",
          {{"type", "label"}},
          "Segmentation",
          ModuleParameter::Channel::Input};
}

ModuleParameter threadsParameter(int& threads) {
  return {
      .option = {.flags = "--threads", .target = &threads, .help = "threads; 0: all processors", .least = 0}};
}

ModuleParameter resultParameter(const std::string& name, std::int64_t& value, const std::string& help) {
  return {.option = {name, &value, help}, .channel = ModuleParameter::Channel::Output};
}

}  // namespace sinew
