#include "UnderResolution.h"

#include "Digits.h"
#include "TopologyDifferences.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sinew {
namespace {

constexpr double kCubesAlongPiece = 3;  // at which a lone piece of some voxels is seen

std::string count(std::int64_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

/// Down to two significant digits.
double roundedDown(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return unit * std::floor(value / unit * (1 + 1e-9));
}

/// Text in quotes that a shell takes as it is.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string widest(const TopologyDifference& difference) {
  std::string place;
  for (const double x : difference.place) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", x);
    place += (place.empty() ? "" : ", ") + std::string(text);
  }
  return std::string("at its widest a ") + toString(difference.change) + ", " +
         threeDigits(difference.width) + " mm across, at (" + place + ") mm, " + difference.reason;
}

}  // namespace

std::string sizeOption(const std::string& tissue, double edge) {
  return "--size " + quoted(tissue + "=" + threeDigits(roundedDown(edge)) + "mm");
}

std::string underResolution(const TissueReport& report) {
  constexpr double kVolumeError = 0.05;
  std::string signs;
  const auto add = [&](const std::string& sign) { signs += (signs.empty() ? "" : ", ") + sign; };

  double edge = report.edgeLength / 2;
  if (report.lost.components > 0) {
    add(count(report.lost.components, "piece") + " of " + threeDigits(report.lost.volume) +
        " mm^3 in all lost");
    const double piece = report.lost.volume / static_cast<double>(report.lost.components);
    edge = std::min(edge, std::cbrt(piece) / kCubesAlongPiece);
  }
  if (report.topology.components != report.levelSetComponents)
    add(count(report.topology.components, "component") + " instead of " +
        std::to_string(report.levelSetComponents));
  if (report.topology.eulerCharacteristic != report.levelSetEuler)
    add("Euler characteristic " + std::to_string(report.topology.eulerCharacteristic) + " instead of " +
        std::to_string(report.levelSetEuler));
  if (!signs.empty() && !report.topologyDifferences.empty()) add(widest(report.topologyDifferences.front()));
  const double error = report.fidelity.volume / report.fidelity.levelSetVolume - 1;
  if (std::abs(error) > kVolumeError)
    add("volume " + threeDigits(100 * std::abs(error)) + " % too " + (error < 0 ? "small" : "large"));
  return signs.empty() ? "" : "under-resolved: " + signs + "; try " + sizeOption(report.name, edge);
}

}  // namespace sinew
