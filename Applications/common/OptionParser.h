#pragma once

#include "Option.h"

#include <CLI/CLI.hpp>

namespace sinew {

/// Adds an option to a command line; what it reads goes to the option's target, which must outlive the
/// parsing.
CLI::Option* addOption(CLI::App& app, const Option& option, ListStyle lists = ListStyle::Repeated);

/// Adds options in their order.
void addOptions(CLI::App& app, const std::vector<Option>& options);

/// Takes numbers from `least` on.
CLI::Validator atLeast(double least);

}  // namespace sinew
