#include "Value.h"

#include <cmath>
#include <cstdio>

namespace sinew::repair {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::string shapeText(const Shape& shape) {
  if (shape.name.empty()) return shape.solid ? "a solid" : "a shape";
  return (shape.untouched ? "tissue " : "shape of ") + quoted(shape.name);
}

std::string tableText(const Table& table) {
  std::string text;
  const auto add = [&](const std::string& entry) { text += (text.empty() ? "" : ", ") + entry; };
  for (const Value& item : table.items) add(toText(item));
  for (const auto& [name, value] : table.fields) add(name + "=" + toText(value));
  return "{" + text + "}";
}

}  // namespace

std::string toText(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.14g", number);
  return text;
}

std::string quoted(const std::string& text, char mark) {
  constexpr std::size_t most = 60;
  std::string shown;
  for (const char c : text.substr(0, most))
    shown += static_cast<unsigned char>(c) < ' ' || c == 127 ? ' ' : c;
  if (text.size() > most) {
    while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80) shown.pop_back();
    if (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0x80) != 0) shown.pop_back();
    shown += "...";
  }
  return mark + shown + mark;
}

std::string toText(const Value& value) {
  return std::visit(
      Overloaded{[](std::monostate) -> std::string { return "nil"; },
                 [](bool b) -> std::string { return b ? "true" : "false"; },
                 [](double number) { return toText(number); }, [](const std::string& text) { return text; },
                 [](const ShapePtr& shape) { return shapeText(*shape); },
                 [](const TablePtr& table) { return tableText(*table); },
                 [](const Foreign& foreign) { return foreign.type; }},
      value);
}

std::string describe(const Value& value) {
  return std::visit(Overloaded{[](std::monostate) -> std::string { return "nothing"; },
                               [](bool b) -> std::string { return b ? "true" : "false"; },
                               [](double number) { return toText(number); },
                               [](const std::string& text) { return "the text " + quoted(text, '"'); },
                               [](const ShapePtr&) -> std::string { return "a shape"; },
                               [](const TablePtr&) -> std::string { return "a table"; },
                               [](const Foreign& foreign) { return "a " + foreign.type; }},
                    value);
}

}  // namespace sinew::repair
