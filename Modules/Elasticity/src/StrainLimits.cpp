#include "sinew/Elasticity/StrainLimits.h"

#include "NodeSums.h"
#include "sinew/Elasticity/Altitude.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace sinew {
namespace {

constexpr double kSlack = 1e-12;  // of the altitude: no impulses for what is round-off

/// The four heights of a tet and their rates, as altitude() and Altitude::rate give them one by one:
///     height_i = 6V / |c_i|,  rate_i = sum_j (c_i . v_j) (c_j . c_i) / |c_i|^3
/// with c_i the inward normal of the face opposite to node i, twice its area long, and 6V = e_1 . c_1.
struct Heights {
  std::array<double, 4> now, rate;

  Heights(const NodeVectors& places, const NodeVectors& velocities, const Tet& tet) {
    const Eigen::Matrix3d e = edgeVectors(places, tet), v = edgeVectors(velocities, tet);
    std::array<Eigen::Vector3d, 4> c;
    c[1] = e.col(1).cross(e.col(2));
    c[2] = e.col(2).cross(e.col(0));
    c[3] = e.col(0).cross(e.col(1));
    c[0] = -(c[1] + c[2] + c[3]);
    const double volume6 = e.col(0).dot(c[1]);
    for (std::size_t i = 0; i < 4; ++i) {
      const double length2 = c[i].squaredNorm(), length = std::sqrt(length2);
      now[i] = volume6 / length;
      rate[i] = (c[i].dot(v.col(0)) * c[1].dot(c[i]) + c[i].dot(v.col(1)) * c[2].dot(c[i]) +
                 c[i].dot(v.col(2)) * c[3].dot(c[i])) /
                (length2 * length);
    }
  }
};

}  // namespace

StrainLimits::StrainLimits(const ElasticBody& body, const StrainLimitOptions& options)
    : body_(body), options_(options), altitudes_(body.tets.size()) {
  if (!(options.strain > 0 && options.strain < 1))
    throw std::invalid_argument("StrainLimits: strain must be in (0, 1)");
  if (!(options.change > 0)) throw std::invalid_argument("StrainLimits: change must be positive");
  if (options.sweeps < 1) throw std::invalid_argument("StrainLimits: sweeps must be 1 or more");
  const NodeVectors still(body.nodeCount(), Eigen::Vector3d::Zero());
  forEachIndex(altitudes_.size(),
               [&](std::size_t t) { altitudes_[t] = Heights(body.rest, still, body.tets[t]).now; });
}

double StrainLimits::excess(double atRest, double now, double next) const {
  const double inBounds = std::clamp(next, (1 - options_.strain) * atRest, (1 + options_.strain) * atRest);
  const double target = std::clamp(inBounds, now - options_.change * atRest, now + options_.change * atRest);
  return std::abs(target - next) <= kSlack * atRest ? 0 : target - next;
}

bool StrainLimits::breaks(const NodeVectors& places, const NodeVectors& velocities, double dt,
                          std::size_t tet) const {
  const Heights heights(places, velocities, body_.tets[tet]);
  for (std::size_t i = 0; i < 4; ++i)
    if (excess(altitudes_[tet][i], heights.now[i], heights.now[i] + dt * heights.rate[i]) != 0) return true;
  return false;
}

std::size_t StrainLimits::limitTet(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                                   std::size_t tet, NodeVectors& velocities) const {
  const Tet& nodes = body_.tets[tet];
  const auto node = [&](int i) { return static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)]); };
  std::size_t impulses = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const Altitude now = altitude(places, nodes, corner);
    const double change = excess(altitudes_[tet][static_cast<std::size_t>(corner)], now.height,
                                 now.height + dt * now.rate(velocities, nodes));
    if (change == 0) continue;
    Eigen::Vector4d responses;  // velocity of a node per impulse
    for (int i = 0; i < 4; ++i)
      responses[i] =
          now.weights[i] * constraints.free(node(i), now.normal).dot(now.normal) / body_.masses[node(i)];
    const double response = responses.dot(now.weights);
    if (!(response > 0)) continue;
    const double impulse = change / (dt * response);
    for (int i = 0; i < 4; ++i)
      velocities[node(i)] += constraints.free(
          node(i), Eigen::Vector3d(impulse * now.weights[i] / body_.masses[node(i)] * now.normal));
    ++impulses;
  }
  return impulses;
}

std::size_t StrainLimits::apply(const NodeConstraints& constraints, const NodeVectors& places, double dt,
                                NodeVectors& velocities) const {
  std::vector<std::uint8_t> flags(body_.tets.size());
  forEachIndex(flags.size(), [&](std::size_t t) { flags[t] = breaks(places, velocities, dt, t); });
  std::vector<std::int32_t> tets;
  for (std::size_t t = 0; t < flags.size(); ++t)
    if (flags[t] != 0) tets.push_back(static_cast<std::int32_t>(t));

  std::size_t impulses = 0;
  for (int sweep = 0; sweep < options_.sweeps && !tets.empty(); ++sweep) {
    impulses = 0;
    for (const std::int32_t t : tets) {
      impulses += limitTet(constraints, places, dt, static_cast<std::size_t>(t), velocities);
      flags[static_cast<std::size_t>(t)] = 0;
    }
    std::vector<std::int32_t> next;
    for (const std::int32_t t : tets)
      for (const std::int32_t node : body_.tets[static_cast<std::size_t>(t)])
        for (std::int32_t k = body_.firstCorner[static_cast<std::size_t>(node)];
             k < body_.firstCorner[static_cast<std::size_t>(node) + 1]; ++k) {
          const auto other = static_cast<std::size_t>(body_.corners[static_cast<std::size_t>(k)] / 4);
          if (std::exchange(flags[other], std::uint8_t{1}) == 0)
            next.push_back(static_cast<std::int32_t>(other));
        }
    for (const std::int32_t t : next) flags[static_cast<std::size_t>(t)] = 0;
    std::erase_if(
        next, [&](std::int32_t t) { return !breaks(places, velocities, dt, static_cast<std::size_t>(t)); });
    tets = std::move(next);
  }
  return tets.empty() ? 0 : impulses;
}

}  // namespace sinew
