#pragma once

#include "sinew/Elasticity/ElasticBody.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace sinew {

inline constexpr std::size_t kElasticBlock = 1024;  // tets or nodes per task

template <class Function>
void forEachIndex(std::size_t count, const Function& f) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kElasticBlock), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) f(i);
  });
}

/// Sum of f(i) for i < count, the same bits for any number of threads.
template <class Function>
double deterministicSum(std::size_t count, const Function& f) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, count, kElasticBlock), 0.,
      [&](const auto& range, double sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) sum += f(i);
        return sum;
      },
      [](double a, double b) { return a + b; });
}

/// (x1 - x0, x2 - x0, x3 - x0)
inline Eigen::Matrix3d edgeVectors(const NodeVectors& places, const Tet& tet) {
  const Eigen::Vector3d& x0 = places[static_cast<std::size_t>(tet[0])];
  Eigen::Matrix3d edges;
  for (int c = 0; c < 3; ++c) edges.col(c) = places[static_cast<std::size_t>(tet[c + 1])] - x0;
  return edges;
}

/// What the tets around each node do to it: column c of ofTet(t) goes to node c + 1 of the tet, minus their
/// sum to node 0, so that no tet changes the momentum. Added to `sum` in the order of the corners.
template <class OfTet>
void addTetForces(const ElasticBody& body, const OfTet& ofTet, NodeVectors& sum) {
  std::vector<Eigen::Matrix3d> forces(body.tets.size());
  forEachIndex(body.tets.size(), [&](std::size_t t) { forces[t] = ofTet(t); });
  forEachIndex(body.nodeCount(), [&](std::size_t n) {
    for (std::int32_t k = body.firstCorner[n]; k < body.firstCorner[n + 1]; ++k) {
      const auto corner = static_cast<std::size_t>(body.corners[static_cast<std::size_t>(k)]);
      const Eigen::Matrix3d& force = forces[corner / 4];
      if (corner % 4 == 0)
        sum[n] -= force.rowwise().sum();
      else
        sum[n] += force.col(static_cast<Eigen::Index>(corner % 4 - 1));
    }
  });
}

}  // namespace sinew
