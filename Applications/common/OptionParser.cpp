#include "OptionParser.h"

namespace sinew {
namespace {

/// An option whose text `parse` turns into a value, or refuses by std::invalid_argument.
template <typename Value>
CLI::Option* addParsed(CLI::App& app, const Option& option, Value* value, Value (*parse)(std::string_view)) {
  const auto read = [value, parse](const std::string& text) {
    try {
      *value = parse(text);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(error.what());
    }
  };
  return app.add_option_function<std::string>(option.flags, read, option.help)
      ->default_str(defaultText(option));
}

/// What a form like `NAME=VALUE` asks for.
CLI::Validator isPair(const std::string& form) {
  const auto check = [form](std::string& text) -> std::string {
    const auto equals = text.find('=');
    return equals == text.npos || equals == 0 ? "'" + text + "' is not " + form : std::string();
  };
  return CLI::Validator(check, "");
}

/// Adds the option for each type of target.
struct Adder {
  CLI::App& app;
  const Option& option;
  ListStyle lists;

  CLI::Option* operator()(bool* value) const { return app.add_flag(option.flags, *value, option.help); }
  CLI::Option* operator()(Length* value) const {
    return addParsed(app, option, value, &parseLength)->type_name("LENGTH");
  }
  CLI::Option* operator()(Smoothing* value) const {
    return addParsed(app, option, value, &parseSmoothing)->type_name("HOW");
  }
  CLI::Option* operator()(std::vector<std::string>* value) const {
    CLI::Option* added = app.add_option(option.flags, *value, helpText(option, lists));
    if (lists == ListStyle::Commas && !option.mayHoldCommas) added->delimiter(',');
    return added->expected(1)->take_all();
  }
  CLI::Option* operator()(std::string* value) const {
    CLI::Option* added = app.add_option(option.flags, *value, option.help);
    return value->empty() ? added : added->capture_default_str();
  }
  template <typename Value>
  CLI::Option* operator()(std::optional<Value>* value) const {
    return app.add_option(option.flags, *value, option.help);
  }
  template <typename Number>
  CLI::Option* operator()(Number* value) const {
    return app.add_option(option.flags, *value, option.help)->capture_default_str();
  }
};

}  // namespace

CLI::Option* addOption(CLI::App& app, const Option& option, ListStyle lists) {
  CLI::Option* added = std::visit(Adder{app, option, lists}, option.target);
  if (!option.form.empty()) added->type_name(option.form);
  if (option.form.find('=') != option.form.npos) added->check(isPair(option.form));
  if (!option.choices.empty()) added->check(CLI::IsMember(option.choices));
  if (option.least) added->check(atLeast(*option.least));
  return added;
}

void addOptions(CLI::App& app, const std::vector<Option>& options) {
  for (const Option& option : options) addOption(app, option);
}

CLI::Validator atLeast(double least) {
  const auto check = [least](std::string& text) -> std::string {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= least) return {};
    return "'" + text + "' is not a number from " + CLI::detail::to_string(least) + " on";
  };
  return CLI::Validator(check, "");
}

}  // namespace sinew
