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

EdgeSprings::EdgeSprings(const ElasticBody& body, const SpringOptions& options)
    : body_(body), damping_(options.damping) {
  requireSound(options);
  const auto around = tetsAroundEdges(body.tets);
  springs_.resize(body.tets.size());
  for (std::size_t t = 0; t < body.tets.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] = endsOf(body.tets[t], e);
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const double m = harmonicMean(body.masses[i], body.masses[j]), share = 1. / around[t][e];
      const double length = (body.rest[j] - body.rest[i]).norm(), stiffness = springRate(options, m, length);
      springs_[t][e] = {length, share * stiffness, share * options.damping * 2 * std::sqrt(stiffness * m)};
    }
}

/// Calls f(edge, i, j, spring) for the edges of a tet, from node i to node j.
template <class Function>
void EdgeSprings::forEdges(std::size_t tet, const Function& f) const {
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [p, q] = kTetEdges[e];
    f(kTetEdges[e], static_cast<std::size_t>(body_.tets[tet][static_cast<std::size_t>(p)]),
      static_cast<std::size_t>(body_.tets[tet][static_cast<std::size_t>(q)]), springs_[tet][e]);
  }
}

/// Adds what pull(i, j, spring) says pulls node i towards node j, and the opposite on j.
template <class Pull>
void EdgeSprings::addPulls(const Pull& pull, NodeVectors& forces) const {
  addTetForces(
      body_,
      [&](std::size_t t) {
        TetForces ofTet;
        forEdges(t, [&](const std::array<int, 2>& edge, std::size_t i, std::size_t j, const Spring& spring) {
          const Vector3d force = pull(i, j, spring);
          ofTet.add(edge[0], force);
          ofTet.add(edge[1], -force);
        });
        return ofTet.columns();
      },
      forces);
}

double EdgeSprings::energy(const NodeVectors& places) const {
  return deterministicSum(body_.tets.size(), [&](std::size_t t) {
    double sum = 0;
    forEdges(t, [&](const std::array<int, 2>&, std::size_t i, std::size_t j, const Spring& spring) {
      const double stretch = (places[j] - places[i]).norm() - spring.length;
      sum += spring.stiffness * stretch * stretch / 2;
    });
    return sum;
  });
}

void EdgeSprings::addForces(const NodeVectors& places, NodeVectors& forces) const {
  addPulls(
      [&](std::size_t i, std::size_t j, const Spring& spring) -> Vector3d {
        const Vector3d along = places[j] - places[i];
        const double length = along.norm();
        if (!(length > 0)) return Vector3d::Zero();
        return spring.stiffness * (length - spring.length) / length * along;
      },
      forces);
}

void EdgeSprings::moveTo(const NodeVectors& places) { places_ = places; }

void EdgeSprings::addDamping(const NodeVectors& velocities, NodeVectors& forces) const {
  if (damping_ == 0) return;
  addPulls(
      [&](std::size_t i, std::size_t j, const Spring& spring) -> Vector3d {
        const Vector3d u = (places_[j] - places_[i]).normalized();
        return spring.damping * u.dot(velocities[j] - velocities[i]) * u;
      },
      forces);
}

}  // namespace sinew
