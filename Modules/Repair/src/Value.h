#pragma once

#include "Shape.h"

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace sinew::repair {

struct Table;
using TablePtr = std::shared_ptr<const Table>;

/// A type of the script that no function here takes: a function, say.
struct Foreign {
  std::string type;
};

/// What passes between the script and the program, whatever language the script is in.
using Value = std::variant<std::monostate, bool, double, std::string, ShapePtr, TablePtr, Foreign>;
using Values = std::vector<Value>;

struct Table {
  Values items;                         ///< [1], [2], ...
  std::map<std::string, Value> fields;  ///< named
};

/// As `print` shows it: {1, 2, name="humerus"}.
std::string toText(const Value& value);

/// As an error message names it: `the text "6cm"`, `a table`, `nothing`.
std::string describe(const Value& value);

/// Shortest text of a number, without a point for whole ones.
std::string toText(double number);

/// A text in quotes, cut where it is long, without control characters.
std::string quoted(const std::string& text, char mark = '\'');

}  // namespace sinew::repair
