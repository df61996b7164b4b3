#include "VolumeOffset.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

/// Change of the volume with the offset, mm^2: the area, unless the last two trials tell better.
double growth(const std::vector<OffsetTrial>& trials, double area) {
  constexpr double kPlausible = 2;  // times more or less than the area
  if (trials.size() < 2) return area;
  const OffsetTrial &a = trials[trials.size() - 2], &b = trials.back();
  const double secant = (b.volume - a.volume) / (b.offset - a.offset);
  return secant > area / kPlausible && secant < area * kPlausible ? secant : area;
}

}  // namespace

bool goodVolume(const OffsetTrial& trial, double wantedVolume, const VolumeRule& rule) {
  return std::abs(trial.volume - wantedVolume) <= rule.tolerance * wantedVolume;
}

std::size_t bestTrial(const std::vector<OffsetTrial>& trials, double wantedVolume) {
  const auto best = std::ranges::min_element(
      trials, {}, [&](const OffsetTrial& trial) { return std::abs(trial.volume - wantedVolume); });
  return static_cast<std::size_t>(best - trials.begin());
}

std::optional<double> nextOffset(const std::vector<OffsetTrial>& trials, double wantedVolume, double area,
                                 double edge, const VolumeRule& rule) {
  if (goodVolume(trials[bestTrial(trials, wantedVolume)], wantedVolume, rule)) return std::nullopt;
  if (static_cast<int>(trials.size()) >= rule.trials) return std::nullopt;
  const double largest = rule.largestEdges * edge;
  const double offset = trials.back().offset + (wantedVolume - trials.back().volume) / growth(trials, area);
  const double allowed = std::clamp(offset, -largest, largest);
  const bool tried =
      std::ranges::any_of(trials, [&](const OffsetTrial& trial) { return trial.offset == allowed; });
  return tried ? std::nullopt : std::optional(allowed);
}

}  // namespace sinew
