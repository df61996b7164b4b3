#pragma once

#include <array>
#include <string>
#include <vector>

namespace sinew {

/// A line of a chart.
struct ChartLine {
  std::string colour;                         ///< as SVG has it
  std::vector<std::array<double, 2>> points;  ///< those that are not finite are left out
  bool cutOff = false;                        ///< a cross at its end
};

/// A chart with time along its lower edge.
struct Chart {
  std::string title, unit;  ///< any characters; the unit may be empty
  std::vector<ChartLine> lines;
  bool mayBeLogarithmic = false;
};

inline constexpr double kChartWidth = 330, kChartHeight = 230;

/// The chart with its upper left corner at (x, y), as SVG elements.
std::string svgChart(const Chart& chart, double x, double y);

/// A text element. @param anchor  start, middle or end
std::string svgText(double x, double y, const std::string& text, const char* anchor, const char* style = "");

/// Text for XML.
std::string escaped(const std::string& text);

}  // namespace sinew
