#include "sinew/Elasticity/StrainLimits.h"

#include "NodeSums.h"
#include "TetLanes.h"
#include "sinew/Elasticity/Altitude.h"
#include "sinew/Mesher/VectorClones.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace sinew {
namespace {

constexpr double kSlack = 1e-12;  // of the altitude: no impulses for what is round-off

struct Row3 {
  double x, y, z;
};
inline double dot(Row3 a, Row3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Row3 cross(Row3 a, Row3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// How many heights of each tet break a bound. With c_i the inward normal of the face opposite to node i,
/// twice its area long, and 6V = e_1 . c_1, a height and its rate are
///     h_i = 6V / |c_i|,  h_i' = q_i / |c_i|^3,  q_i = sum_j (c_i . v_j) (c_j . c_i)
/// and here all bounds are multiplied by |c_i|^3.
SINEW_VECTOR_CLONES void countBroken(const TetLanes::Edges& e, const TetLanes::Edges& v, double dt,
                                     const TetLanes::Row* __restrict atRest, double strain, double change,
                                     TetLanes::Row& __restrict broken) {
  for (std::size_t t = 0; t < TetLanes::kTets; ++t) {
    const Row3 e1{e[0][t], e[1][t], e[2][t]}, e2{e[3][t], e[4][t], e[5][t]}, e3{e[6][t], e[7][t], e[8][t]};
    const Row3 v1{v[0][t], v[1][t], v[2][t]}, v2{v[3][t], v[4][t], v[5][t]}, v3{v[6][t], v[7][t], v[8][t]};
    const Row3 c1 = cross(e2, e3), c2 = cross(e3, e1), c3 = cross(e1, e2);
    const Row3 c0{-(c1.x + c2.x + c3.x), -(c1.y + c2.y + c3.y), -(c1.z + c2.z + c3.z)};
    const double volume6 = dot(e1, c1);
    const auto breaks = [&](Row3 c, double rest) {
      const double length2 = dot(c, c), length3 = length2 * std::sqrt(length2);
      const double step = dt * (dot(c, v1) * dot(c1, c) + dot(c, v2) * dot(c2, c) + dot(c, v3) * dot(c3, c));
      const double next = volume6 * length2 + step, slack = (1 + kSlack) * rest * length3;
      const double inside = std::abs(next - rest * length3) - strain * slack;
      const double calm = std::abs(step) - change * slack;
      return inside > 0 || calm > 0 ? 1. : 0.;
    };
    broken[t] = breaks(c0, atRest[0][t]) + breaks(c1, atRest[1][t]) + breaks(c2, atRest[2][t]) +
                breaks(c3, atRest[3][t]);
  }
}

}  // namespace

StrainLimits::StrainLimits(const ElasticBody& body, const StrainLimitOptions& options)
    : body_(body), options_(options), altitudes_(body.tets.size()) {
  if (!(options.strain > 0 && options.strain < 1))
    throw std::invalid_argument("StrainLimits: strain must be in (0, 1)");
  if (!(options.change > 0)) throw std::invalid_argument("StrainLimits: change must be positive");
  if (options.sweeps < 1) throw std::invalid_argument("StrainLimits: sweeps must be 1 or more");
  forEachIndex(altitudes_.size(), [&](std::size_t t) {
    for (int corner = 0; corner < 4; ++corner)
      altitudes_[t][static_cast<std::size_t>(corner)] = altitude(body.rest, body.tets[t], corner).height;
  });
}

double StrainLimits::excess(double atRest, double now, double next) const {
  const double inBounds = std::clamp(next, (1 - options_.strain) * atRest, (1 + options_.strain) * atRest);
  const double target = std::clamp(inBounds, now - options_.change * atRest, now + options_.change * atRest);
  return std::abs(target - next) <= kSlack * atRest ? 0 : target - next;
}

template <class TetAt>
std::vector<std::int32_t> StrainLimits::broken(std::size_t count, const TetAt& tetAt,
                                               const NodeVectors& places, const NodeVectors& velocities,
                                               double dt) const {
  constexpr std::size_t kTets = TetLanes::kTets;
  std::vector<std::uint8_t> flags(count);
  forEachIndex((count + kTets - 1) / kTets, [&](std::size_t group) {
    const std::size_t first = group * kTets, here = std::min(kTets, count - first);
    const auto tetOf = [&](std::size_t lane) { return tetAt(first + std::min(lane, here - 1)); };
    TetLanes::Edges edges, rates;
    std::array<TetLanes::Row, 4> atRest;
    TetLanes::Row breaks;
    TetLanes::gather(body_, tetOf, places, edges);
    TetLanes::gather(body_, tetOf, velocities, rates);
    for (std::size_t lane = 0; lane < kTets; ++lane)
      for (std::size_t i = 0; i < 4; ++i) atRest[i][lane] = altitudes_[tetOf(lane)][i];
    countBroken(edges, rates, dt, atRest.data(), options_.strain, options_.change, breaks);
    for (std::size_t lane = 0; lane < here; ++lane) flags[first + lane] = breaks[lane] > 0;
  });
  std::vector<std::int32_t> tets;
  for (std::size_t k = 0; k < count; ++k)
    if (flags[k] != 0) tets.push_back(static_cast<std::int32_t>(tetAt(k)));
  return tets;
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
  std::vector<std::int32_t> tets = broken(
      body_.tets.size(), [](std::size_t t) { return t; }, places, velocities, dt);
  std::vector<std::uint8_t> listed(tets.empty() ? 0 : body_.tets.size());
  std::size_t impulses = 0;
  for (int sweep = 0; sweep < options_.sweeps && !tets.empty(); ++sweep) {
    impulses = 0;
    std::vector<std::int32_t> next;
    for (const std::int32_t t : tets) {
      const std::size_t given = limitTet(constraints, places, dt, static_cast<std::size_t>(t), velocities);
      impulses += given;
      if (given > 0) addTetsAround(t, listed, next);
    }
    for (const std::int32_t t : next) listed[static_cast<std::size_t>(t)] = 0;
    tets = broken(
        next.size(), [&](std::size_t k) { return static_cast<std::size_t>(next[k]); }, places, velocities,
        dt);
  }
  return tets.empty() ? 0 : impulses;
}

void StrainLimits::addTetsAround(std::int32_t tet, std::vector<std::uint8_t>& listed,
                                 std::vector<std::int32_t>& list) const {
  for (const std::int32_t v : body_.tets[static_cast<std::size_t>(tet)]) {
    const auto node = static_cast<std::size_t>(v);
    for (std::int32_t k = body_.firstCorner[node]; k < body_.firstCorner[node + 1]; ++k) {
      const std::int32_t other = body_.corners[static_cast<std::size_t>(k)] / 4;
      if (std::exchange(listed[static_cast<std::size_t>(other)], std::uint8_t{1}) == 0) list.push_back(other);
    }
  }
}

}  // namespace sinew
