#include "sinew/Simulation/TrialPlot.h"

#include "Numbers.h"
#include "SvgChart.h"

#include <array>

namespace sinew {
namespace {

/// Okabe and Ito's colours, which the colour-blind tell apart; the yellow is left out on white.
constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#56b4e9", "#e69f00"};

struct AmountName {
  const char *title, *unit;
  double scale;
};

/// In the order of Trial.
constexpr std::array<AmountName, kTrials.size()> kAmounts{{{"activation", "", 1},
                                                           {"compression", "%", 100},
                                                           {"depth of the dent", "% of the thickness", 100},
                                                           {"stretch", "%", 100},
                                                           {"twist", "deg", 1}}};

/// What a chart shows of a frame; the first frame is that at rest.
struct Measure {
  const char *title, *unit;
  double (*value)(const TrialFrame& frame, const TrialFrame& rest);
  bool mayBeLogarithmic = false;
};

constexpr std::array kMeasures{
    Measure{"largest aspect ratio", "",
            [](const TrialFrame& frame, const TrialFrame&) { return frame.maxAspectRatio; }, true},
    Measure{"least volume ratio J", "",
            [](const TrialFrame& frame, const TrialFrame&) { return frame.minVolumeRatio; }},
    Measure{"smallest dihedral angle", "deg",
            [](const TrialFrame& frame, const TrialFrame&) { return frame.minDihedralDeg; }},
    Measure{"energy", "mJ", [](const TrialFrame& frame, const TrialFrame&) { return frame.energy / 1000; }},
    Measure{"volume", "% of that at rest",
            [](const TrialFrame& frame, const TrialFrame& rest) { return 100 * frame.volume / rest.volume; }},
};

template <class Value>
Chart chartOf(const std::vector<NamedTrial>& trials, const char* title, const char* unit,
              const Value& value) {
  Chart chart{title, unit, {}};
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialReport& report = trials[i].report;
    ChartLine line{kColours[i % kColours.size()], {}, !report.completed};
    for (const TrialFrame& frame : report.frames)
      line.points.push_back({frame.time, value(frame, report.frames.front())});
    chart.lines.push_back(std::move(line));
  }
  return chart;
}

std::vector<Chart> chartsOf(const std::vector<NamedTrial>& trials, Trial trial) {
  const AmountName& amount = kAmounts[static_cast<std::size_t>(trial)];
  std::vector<Chart> charts{
      chartOf(trials, amount.title, amount.unit,
              [&](const TrialFrame& frame, const TrialFrame&) { return amount.scale * frame.amount; })};
  for (const Measure& measure : kMeasures) {
    charts.push_back(chartOf(trials, measure.title, measure.unit, measure.value));
    charts.back().mayBeLogarithmic = measure.mayBeLogarithmic;
  }
  return charts;
}

constexpr double kMargin = 16, kTitle = 30, kLegendRow = 20;

std::string legend(const std::vector<NamedTrial>& trials, double y) {
  std::string svg;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const double row = y + kLegendRow * static_cast<double>(i);
    svg += "<rect x=\"" + toText(kMargin + 12) + "\" y=\"" + toText(row - 8) +
           "\" width=\"22\" height=\"4\" fill=\"" + kColours[i % kColours.size()] + "\"/>\n";
    svg += svgText(kMargin + 42, row, trials[i].name + (trials[i].report.completed ? "" : " (stopped early)"),
                   "start");
  }
  return svg;
}

}  // namespace

std::string trialPlot(const std::vector<NamedTrial>& trials, Trial trial, const std::string& title) {
  constexpr std::size_t kColumns = 3;
  const std::vector<Chart> charts = chartsOf(trials, trial);
  const double rows = static_cast<double>((charts.size() + kColumns - 1) / kColumns);
  const double legendHeight = trials.size() > 1 ? kLegendRow * static_cast<double>(trials.size()) + 6 : 0;
  const double top = kMargin + kTitle + legendHeight;
  const double width = 2 * kMargin + kColumns * kChartWidth, height = top + rows * kChartHeight + kMargin;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + toText(width, 6) + "\" height=\"" +
                    toText(height, 6) + "\" viewBox=\"0 0 " + toText(width, 6) + ' ' + toText(height, 6) +
                    "\" font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"12\" fill=\"#202020\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  svg += svgText(kMargin + 12, kMargin + 14, title, "start", " font-size=\"16\" font-weight=\"bold\"");
  if (trials.size() > 1) svg += legend(trials, kMargin + kTitle + 8);
  for (std::size_t c = 0; c < charts.size(); ++c)
    svg += svgChart(charts[c], kMargin + kChartWidth * static_cast<double>(c % kColumns),
                    top + kChartHeight * static_cast<double>(c / kColumns));
  return svg + "</svg>\n";
}

}  // namespace sinew
