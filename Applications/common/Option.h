#pragma once

#include "sinew/Pipeline/Length.h"
#include "sinew/Pipeline/Smoothing.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sinew {

/// How the values of a list are given.
enum class ListStyle {
  Repeated,  ///< the flag once for each: `--tissue a --tissue b`
  Commas     ///< in one word, as Slicer does: `--tissue a,b`
};

/// One option of a command, as data: the program's command line and the windows of the Slicer modules are
/// made from the same rows, and so cannot differ.
struct Option {
  using Target =
      std::variant<bool*, int*, std::int64_t*, double*, Length*, Smoothing*, std::string*,
                   std::vector<std::string>*, std::optional<double>*, std::optional<std::filesystem::path>*>;

  std::string flags;  ///< `--edge-length`, or with a short one `-o,--output`; a positional has no dashes
  Target target;      ///< what it sets; its value at the start is the default
  std::string help;
  std::string form = {};                  ///< of the value, `FILE`; empty: by the type
  std::vector<std::string> choices = {};  ///< the only values; none: any
  std::optional<double> least = {};       ///< of a number
  bool mayHoldCommas = false;             ///< of a list: the parser leaves words with commas whole
};

/// The long flag without dashes: `edge-length`.
std::string longName(const Option& option);

/// The help, and for a list how several values are given.
std::string helpText(const Option& option, ListStyle lists);

/// The default as a person would write it; empty for lists, and for what has none.
std::string defaultText(const Option& option);

}  // namespace sinew
