#include "NodeSums.h"
#include "SpringParts.h"

#include <algorithm>
#include <utility>

namespace sinew {
namespace {

using Eigen::Vector3d;

std::pair<std::int32_t, std::int32_t> endsOf(const Tet& tet, std::size_t edge) {
  const auto [a, b] = kTetEdges[edge];
  return std::minmax(tet[static_cast<std::size_t>(a)], tet[static_cast<std::size_t>(b)]);
}

/// How many tets are around each edge of each tet.
std::vector<std::array<int, 6>> tetsAroundEdges(const std::vector<Tet>& tets) {
  struct EdgeOfTet {
    std::pair<std::int32_t, std::int32_t> ends;
    std::size_t place;
  };
  std::vector<EdgeOfTet> edges;
  edges.reserve(6 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) edges.push_back({endsOf(tets[t], e), 6 * t + e});
  std::ranges::sort(edges, {}, [](const EdgeOfTet& edge) { return std::pair(edge.ends, edge.place); });
  std::vector<std::array<int, 6>> counts(tets.size());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last =
        std::find_if(first, edges.end(), [&](const auto& edge) { return edge.ends != first->ends; });
    for (auto edge = first; edge != last; ++edge)
      counts[edge->place / 6][edge->place % 6] = static_cast<int>(last - first);
    first = last;
  }
  return counts;
}

}  // namespace

EdgeSprings::EdgeSprings(const ElasticBody& body, const SpringOptions& options) : body_(body) {
  requireSound(options);
  const double c = options.soundSpeed;
  const auto around = tetsAroundEdges(body.tets);
  springs_.resize(body.tets.size());
  for (std::size_t t = 0; t < body.tets.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = endsOf(body.tets[t], e);
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const double m = harmonicMean(body.masses[i], body.masses[j]), share = 1. / around[t][e];
      const double length = (body.rest[j] - body.rest[i]).norm(), stiffness = c * c * m / (length * length);
      springs_[t][e] = {length, share * stiffness, share * options.damping * 2 * std::sqrt(stiffness * m)};
    }
}

double EdgeSprings::energy(const NodeVectors& places) const {
  return deterministicSum(body_.tets.size(), [&](std::size_t t) {
    double sum = 0;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = endsOf(body_.tets[t], e);
      const Spring& spring = springs_[t][e];
      const double stretch =
          (places[static_cast<std::size_t>(b)] - places[static_cast<std::size_t>(a)]).norm() - spring.length;
      sum += spring.stiffness * stretch * stretch / 2;
    }
    return sum;
  });
}

void EdgeSprings::addForces(const NodeVectors& places, NodeVectors& forces) const {
  addTetForces(
      body_,
      [&](std::size_t t) {
        TetForces ofTet;
        for (std::size_t e = 0; e < 6; ++e) {
          const auto [p, q] = kTetEdges[e];
          const Tet& tet = body_.tets[t];
          const Vector3d along = places[static_cast<std::size_t>(tet[static_cast<std::size_t>(q)])] -
                                 places[static_cast<std::size_t>(tet[static_cast<std::size_t>(p)])];
          const double length = along.norm();
          if (!(length > 0)) continue;
          const Vector3d pull = springs_[t][e].stiffness * (length - springs_[t][e].length) / length * along;
          ofTet.add(p, pull);
          ofTet.add(q, -pull);
        }
        return ofTet.columns();
      },
      forces);
}

void EdgeSprings::moveTo(const NodeVectors& places) { places_ = places; }

void EdgeSprings::addDamping(const NodeVectors& velocities, NodeVectors& forces) const {
  addTetForces(
      body_,
      [&](std::size_t t) {
        TetForces ofTet;
        for (std::size_t e = 0; e < 6; ++e) {
          const auto [p, q] = kTetEdges[e];
          const auto i = static_cast<std::size_t>(body_.tets[t][static_cast<std::size_t>(p)]),
                     j = static_cast<std::size_t>(body_.tets[t][static_cast<std::size_t>(q)]);
          const Vector3d u = (places_[j] - places_[i]).normalized();
          const Vector3d pull = springs_[t][e].damping * u.dot(velocities[j] - velocities[i]) * u;
          ofTet.add(p, pull);
          ofTet.add(q, -pull);
        }
        return ofTet.columns();
      },
      forces);
}

}  // namespace sinew
