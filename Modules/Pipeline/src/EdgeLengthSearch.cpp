#include "EdgeLengthSearch.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// The nearest neighbours with too many tets and, at the larger edge length, too few. Where the number jumps
/// up with the edge length, the others lie the wrong way round.
/// @param points  ascending by edge length
std::optional<std::pair<Point, Point>> narrowestCrossing(const std::vector<Point>& points) {
  std::optional<std::pair<Point, Point>> narrowest;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point &many = points[i], &few = points[i + 1];
    if (many.excess <= 0 || few.excess >= 0) continue;
    const bool narrower = !narrowest || few.edge - many.edge < narrowest->second.edge - narrowest->first.edge;
    if (narrower) narrowest = {many, few};
  }
  return narrowest;
}

/// Beyond all trials, to the side where the number is still wrong: along the secant, as far as it is
/// plausible.
/// @param points  ascending by edge length
double extrapolate(const std::vector<Point>& points) {
  constexpr double kUsualSlope = -2.2, kSteepest = -4, kFlattest = -1.5, kLongestStep = 1.1;
  const std::size_t last = points.size() - 1;
  const bool upwards = points[last].excess > 0;
  const Point& outermost = points[upwards ? last : 0];
  double slope = kUsualSlope;
  if (points.size() > 1) {
    const Point& next = points[upwards ? last - 1 : 1];
    slope = std::clamp((outermost.excess - next.excess) / (outermost.edge - next.edge), kSteepest, kFlattest);
  }
  return outermost.edge + std::clamp(-outermost.excess / slope, -kLongestStep, kLongestStep);
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
  std::ranges::sort(points, {}, &Point::edge);
  const auto crossing = narrowestCrossing(points);
  if (!crossing) return std::exp(extrapolate(points));
  const auto& [many, few] = *crossing;
  if (few.edge - many.edge < kJump) return std::nullopt;
  const double part = stuck ? 0.5 : many.excess / (many.excess - few.excess);
  return std::exp(many.edge + part * (few.edge - many.edge));
}

}  // namespace sinew
