#include "SvgChart.h"

#include "Numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {
namespace {

constexpr double kLeft = 58, kRight = 14, kTop = 36, kBottom = 38;

/// Where the values of an axis lie, and its marks.
struct Axis {
  double from = 0, to = 1;    ///< values at the ends
  double begin = 0, end = 1;  ///< places there, pixels
  bool logarithmic = false;
  std::vector<double> marks = {};

  double place(double value) const {
    const double share =
        logarithmic ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
    return begin + share * (end - begin);
  }
};

/// The step of 1, 2 or 5 times a power of ten that gives about so many marks.
double niceStep(double range, int marks) {
  const double rough = range / marks, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1., 2., 5.})
    if (rough <= factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

void markEvenly(Axis& axis, int marks, bool widen) {
  const double step = niceStep(axis.to - axis.from, marks);
  const auto first =
      std::llround(widen ? std::floor(axis.from / step + 1e-9) : std::ceil(axis.from / step - 1e-9));
  const auto last =
      std::llround(widen ? std::ceil(axis.to / step - 1e-9) : std::floor(axis.to / step + 1e-9));
  for (auto mark = first; mark <= last; ++mark) axis.marks.push_back(step * static_cast<double>(mark));
  if (widen) axis.from = axis.marks.front(), axis.to = axis.marks.back();
}

/// At 1, 2 and 5 times the powers of ten; only the powers where these are many.
void markLogarithmically(Axis& axis) {
  const int first = static_cast<int>(std::floor(std::log10(axis.from)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.to)));
  for (int power = first; power <= last; ++power)
    for (const double factor : {1., 2., 5.})
      if (factor == 1 || last - first <= 2) axis.marks.push_back(factor * std::pow(10, power));
  axis.from = std::min(axis.from, *std::prev(std::ranges::upper_bound(axis.marks, axis.from)));
  const auto end = std::ranges::lower_bound(axis.marks, axis.to);
  if (end != axis.marks.end()) axis.to = *end;
  std::erase_if(axis.marks, [&](double mark) { return mark < axis.from || mark > axis.to; });
}

bool isFinite(const std::array<double, 2>& point) {
  return std::isfinite(point[0]) && std::isfinite(point[1]);
}

/// Over the values of all lines. @param which  0 for time, 1 for values
Axis axisOf(const Chart& chart, std::size_t which) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kLogarithmicFrom = 20;
  Axis axis{.from = kInfinity, .to = -kInfinity};
  for (const ChartLine& line : chart.lines)
    for (const auto& point : line.points)
      if (isFinite(point)) {
        axis.from = std::min(axis.from, point[which]);
        axis.to = std::max(axis.to, point[which]);
      }
  if (axis.from > axis.to) axis.from = 0, axis.to = 1;
  const double least = 1e-3 * std::max(1e-9, std::abs(axis.to));  // a flat line is not noise magnified
  if (axis.to - axis.from < least) axis.from -= least, axis.to += least;
  axis.logarithmic =
      which == 1 && chart.mayBeLogarithmic && axis.from > 0 && axis.to > kLogarithmicFrom * axis.from;
  if (axis.logarithmic)
    markLogarithmically(axis);
  else
    markEvenly(axis, which == 0 ? 4 : 5, which == 1);
  return axis;
}

std::string svgLine(double x1, double y1, double x2, double y2, const char* colour) {
  return "<line x1=\"" + toText(x1) + "\" y1=\"" + toText(y1) + "\" x2=\"" + toText(x2) + "\" y2=\"" +
         toText(y2) + "\" stroke=\"" + colour + "\"/>\n";
}

std::string markText(double mark, double step) { return toText(std::abs(mark) < 1e-9 * step ? 0 : mark, 6); }

std::string frameOf(const Axis& time, const Axis& values) {
  constexpr const char *kGrid = "#e4e4e4", *kEdge = "#808080";
  std::string svg;
  const double step = values.marks.size() > 1 ? values.marks[1] - values.marks[0] : 1;
  for (const double mark : values.marks) {
    const double y = values.place(mark);
    svg += svgLine(time.begin, y, time.end, y, kGrid);
    svg += svgText(time.begin - 6, y + 4, markText(mark, step), "end");
  }
  for (const double mark : time.marks) {
    const double x = time.place(mark);
    svg += svgLine(x, values.begin, x, values.begin + 4, kEdge);
    svg += svgText(x, values.begin + 17, markText(mark, 1), "middle");
  }
  svg += svgLine(time.begin, values.begin, time.end, values.begin, kEdge);
  svg += svgLine(time.begin, values.begin, time.begin, values.end, kEdge);
  return svg + svgText((time.begin + time.end) / 2, values.begin + 31, "time, s", "middle");
}

std::string curveOf(const ChartLine& line, const Axis& time, const Axis& values) {
  std::string places, last;
  for (const auto& point : line.points) {
    if (!isFinite(point)) continue;
    const std::string x = toText(time.place(point[0]), 5), y = toText(values.place(point[1]), 5);
    places += (places.empty() ? "" : " ") + x + ',' + y;
    last = "translate(" + x + ' ' + y + ')';
  }
  std::string svg = "<polyline points=\"" + places + "\" fill=\"none\" stroke=\"" + line.colour +
                    "\" stroke-width=\"1.8\" stroke-linejoin=\"round\"/>\n";
  if (line.cutOff && !last.empty())
    svg += "<path d=\"M-4-4L4 4M-4 4L4-4\" transform=\"" + last + "\" stroke=\"" + line.colour +
           "\" stroke-width=\"2\"/>\n";
  return svg;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < ' ' ? '?' : c;
    }
  }
  return safe;
}

std::string svgText(double x, double y, const std::string& text, const char* anchor, const char* style) {
  return "<text x=\"" + toText(x, 5) + "\" y=\"" + toText(y, 5) + "\" text-anchor=\"" + anchor + "\"" +
         style + ">" + escaped(text) + "</text>\n";
}

std::string svgChart(const Chart& chart, double x, double y) {
  Axis time = axisOf(chart, 0), values = axisOf(chart, 1);
  time.begin = x + kLeft, time.end = x + kChartWidth - kRight;
  values.begin = y + kChartHeight - kBottom, values.end = y + kTop;
  std::string svg =
      svgText(time.begin, y + kTop - 12, chart.title + (chart.unit.empty() ? "" : ", " + chart.unit), "start",
              " font-weight=\"bold\"");
  svg += frameOf(time, values);
  for (const ChartLine& line : chart.lines) svg += curveOf(line, time, values);
  return svg;
}

}  // namespace sinew
