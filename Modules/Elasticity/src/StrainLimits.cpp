#include "sinew/Elasticity/StrainLimits.h"

#include "NodeSums.h"
#include "sinew/Elasticity/Altitude.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace sinew {
namespace {

/// Greedy: each tet gets the first colour that no earlier tet around its nodes has.
std::vector<std::vector<std::int32_t>> colorTets(const ElasticBody& body) {
  std::vector<int> colorOf(body.tets.size(), -1);
  std::vector<std::vector<std::int32_t>> colors;
  std::vector<std::size_t> takenBy;  // the tet that last saw the colour around it
  for (std::size_t t = 0; t < body.tets.size(); ++t) {
    for (const std::int32_t node : body.tets[t])
      for (std::int32_t k = body.firstCorner[static_cast<std::size_t>(node)];
           k < body.firstCorner[static_cast<std::size_t>(node) + 1]; ++k) {
        const int color = colorOf[static_cast<std::size_t>(body.corners[static_cast<std::size_t>(k)]) / 4];
        if (color >= 0) takenBy[static_cast<std::size_t>(color)] = t;
      }
    const auto isFree = [&](std::size_t taker) { return taker != t; };
    const auto found = std::ranges::find_if(takenBy, isFree);
    colorOf[t] = static_cast<int>(found - takenBy.begin());
    if (found == takenBy.end()) {
      takenBy.push_back(SIZE_MAX);
      colors.emplace_back();
    }
    colors[static_cast<std::size_t>(colorOf[t])].push_back(static_cast<std::int32_t>(t));
  }
  return colors;
}

}  // namespace

StrainLimits::StrainLimits(const ElasticBody& body, const StrainLimitOptions& options)
    : body_(body), options_(options), altitudes_(body.tets.size()), colors_(colorTets(body)) {
  if (!(options.strain > 0 && options.strain < 1))
    throw std::invalid_argument("StrainLimits: strain must be in (0, 1)");
  if (!(options.change > 0)) throw std::invalid_argument("StrainLimits: change must be positive");
  if (options.sweeps < 1) throw std::invalid_argument("StrainLimits: sweeps must be 1 or more");
  forEachIndex(altitudes_.size(), [&](std::size_t t) {
    for (int corner = 0; corner < 4; ++corner)
      altitudes_[t][static_cast<std::size_t>(corner)] = altitude(body.rest, body.tets[t], corner).height;
  });
}

std::size_t StrainLimits::limitTet(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                                   std::size_t tet, NodeVectors& velocities) const {
  constexpr double kSlack = 1e-12;  // of the altitude: no impulses for what is round-off
  const Tet& nodes = body_.tets[tet];
  const auto node = [&](int i) { return static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)]); };
  std::size_t impulses = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const Altitude now = altitude(places, nodes, corner);
    const double atRest = altitudes_[tet][static_cast<std::size_t>(corner)];
    const double next = now.height + dt * now.rate(velocities, nodes);
    const double inBounds = std::clamp(next, (1 - options_.strain) * atRest, (1 + options_.strain) * atRest);
    const double target =
        std::clamp(inBounds, now.height - options_.change * atRest, now.height + options_.change * atRest);
    if (std::abs(target - next) <= kSlack * atRest) continue;
    Eigen::Vector4d responses;  // velocity of a node per impulse
    for (int i = 0; i < 4; ++i)
      responses[i] =
          now.weights[i] * constraints.free(node(i), now.normal).dot(now.normal) / body_.masses[node(i)];
    const double response = responses.dot(now.weights);
    if (!(response > 0)) continue;
    const double impulse = (target - next) / (dt * response);
    for (int i = 0; i < 4; ++i)
      velocities[node(i)] += constraints.free(
          node(i), Eigen::Vector3d(impulse * now.weights[i] / body_.masses[node(i)] * now.normal));
    ++impulses;
  }
  return impulses;
}

std::size_t StrainLimits::apply(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                                NodeVectors& velocities) const {
  std::size_t impulses = 0;
  for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
    impulses = 0;
    for (const auto& color : colors_)
      impulses += static_cast<std::size_t>(deterministicSum(color.size(), [&](std::size_t k) {
        return static_cast<double>(
            limitTet(constraints, places, dt, static_cast<std::size_t>(color[k]), velocities));
      }));
    if (impulses == 0) break;
  }
  return impulses;
}

}  // namespace sinew
