#include "EdgeLengthSearch.h"

#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

/// Logarithms of a trial.
struct Point {
  double edge;
  double excess;  ///< of the tets over the wanted number; falls with the edge length
};

Point pointOf(const SizeTrial& trial, std::int64_t wanted) {
  constexpr double kOfNothing = 0.5;  // tets: an empty mesh has fewer than one
  const double tets = trial.tets > 0 ? static_cast<double>(trial.tets) : kOfNothing;
  return {std::log(trial.edge), std::log(tets / static_cast<double>(wanted))};
}

/// Beyond all trials: along the secant through the two best ones, as far as it is plausible.
double extrapolate(const std::vector<Point>& nearestFirst) {
  constexpr double kUsualSlope = -2.2, kSteepest = -4, kFlattest = -1.5, kLongestStep = 1.1;
  const Point& best = nearestFirst.front();
  double slope = kUsualSlope;
  if (nearestFirst.size() > 1 && nearestFirst[1].edge != best.edge)
    slope = std::clamp((nearestFirst[1].excess - best.excess) / (nearestFirst[1].edge - best.edge), kSteepest,
                       kFlattest);
  return best.edge + std::clamp(-best.excess / slope, -kLongestStep, kLongestStep);
}

}  // namespace

bool hasTets(std::int64_t tets, std::int64_t wanted) {
  constexpr double kTolerance = 0.1;
  return std::abs(static_cast<double>(tets - wanted)) <= kTolerance * static_cast<double>(wanted);
}

std::size_t bestTrial(const std::vector<SizeTrial>& trials, std::int64_t wanted) {
  const auto best = std::ranges::min_element(
      trials, {}, [&](const SizeTrial& trial) { return std::abs(pointOf(trial, wanted).excess); });
  return static_cast<std::size_t>(best - trials.begin());
}

double firstEdgeLength(double area, double volume, std::int64_t wanted) {
  constexpr double kSurfaceTets = 30, kVolumeTets = 12;  // measured on phantoms; a BCC cube holds 12 tets
  const auto count = static_cast<double>(wanted);
  return std::min(std::sqrt(kSurfaceTets * area / count), std::cbrt(kVolumeTets * volume / count));
}

std::optional<double> nextEdgeLength(const std::vector<SizeTrial>& trials, std::int64_t wanted) {
  constexpr double kJump = 0.002;  // of the edge length: between such near ones lies no other number
  if (hasTets(trials[bestTrial(trials, wanted)].tets, wanted)) return std::nullopt;
  if (trials.size() == kMostSizeTrials) return std::nullopt;

  std::vector<Point> points;
  for (const SizeTrial& trial : trials) points.push_back(pointOf(trial, wanted));
  const Point last = points.back();
  const bool stuck = points.size() > 2 && last.excess * points[points.size() - 2].excess > 0;
  std::ranges::stable_sort(points, {}, [](const Point& point) { return std::abs(point.excess); });
  const auto many = std::ranges::find_if(points, [](const Point& point) { return point.excess > 0; });
  const auto few = std::ranges::find_if(points, [](const Point& point) { return point.excess < 0; });

  double edge = 0;
  if (many == points.end() || few == points.end()) {
    edge = extrapolate(points);
  } else {
    if (std::abs(few->edge - many->edge) < kJump) return std::nullopt;
    const double part = stuck ? 0.5 : many->excess / (many->excess - few->excess);
    edge = many->edge + part * (few->edge - many->edge);
  }
  return std::exp(edge);
}

}  // namespace sinew
