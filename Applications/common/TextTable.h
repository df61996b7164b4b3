#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace sinew {

enum class Align { Left, Right };
enum class Tone { Plain, Good, Warning, Bad };

/// A table for people: columns as wide as their widest cell, counted in columns of a terminal.
class TextTable {
 public:
  struct Column {
    std::string title;
    Align align = Align::Right;
  };
  struct Cell {
    std::string text;
    Tone tone = Tone::Plain;
    Cell(std::string text, Tone tone = Tone::Plain) : text(std::move(text)), tone(tone) {}
    Cell(const char* text) : text(text) {}
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }
  /// Tones become colours only on a terminal, and not when NO_COLOR is set.
  void print(std::ostream& stream) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// Columns that UTF-8 text takes on a terminal.
std::size_t displayWidth(const std::string& text);
/// Text without anything that could control a terminal.
std::string printable(std::string text);

std::string fixed(double value, int decimals);
/// The same with a sign, also for positive values.
std::string signedFixed(double value, int decimals);
/// With marks between thousands: 1,234,567.
std::string grouped(std::int64_t value);
/// RGB in 0..1 as `#rrggbb`.
std::string colourCode(const std::array<double, 3>& colour);

}  // namespace sinew
