#include "sinew/Elasticity/ElasticBody.h"

#include "NodeSums.h"

#include <Eigen/LU>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

/// Sorts the corners of all tets by their node.
void listCorners(ElasticBody& body) {
  body.firstCorner.assign(body.nodeCount() + 1, 0);
  for (const Tet& tet : body.tets)
    for (const std::int32_t node : tet) ++body.firstCorner[static_cast<std::size_t>(node) + 1];
  for (std::size_t n = 1; n < body.firstCorner.size(); ++n) body.firstCorner[n] += body.firstCorner[n - 1];
  body.corners.resize(4 * body.tets.size());
  std::vector<std::int32_t> next(body.firstCorner.begin(), body.firstCorner.end() - 1);
  for (std::size_t corner = 0; corner < body.corners.size(); ++corner) {
    const std::int32_t node = body.tets[corner / 4][corner % 4];
    body.corners[static_cast<std::size_t>(next[static_cast<std::size_t>(node)]++)] =
        static_cast<std::int32_t>(corner);
  }
}

}  // namespace

ElasticBody elasticBody(const TetMesh& mesh, double density) {
  if (!(density > 0)) throw std::invalid_argument("elasticBody: the density must be positive");
  ElasticBody body;
  body.rest = mesh.nodes;
  body.tets = mesh.tets;
  body.inverseEdges.resize(mesh.tets.size());
  body.volumes.resize(mesh.tets.size());
  body.masses.assign(mesh.nodes.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Eigen::Matrix3d edges = edgeVectors(mesh.nodes, mesh.tets[t]);
    const double volume = edges.determinant() / 6;
    if (!(volume > 0))
      throw std::invalid_argument("elasticBody: tet " + std::to_string(t) + " has no positive volume");
    body.inverseEdges[t] = edges.inverse();
    body.volumes[t] = volume;
    for (const std::int32_t node : mesh.tets[t])
      body.masses[static_cast<std::size_t>(node)] += density * volume / 4;
  }
  listCorners(body);
  return body;
}

Eigen::Matrix3d deformationGradient(const ElasticBody& body, const NodeVectors& places, std::size_t tet) {
  return edgeVectors(places, body.tets[tet]) * body.inverseEdges[tet];
}

double leastVolumeRatio(const ElasticBody& body, const NodeVectors& places) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, body.tets.size()), body.tets.empty() ? 1. : 1e300,
      [&](const auto& range, double least) {
        for (std::size_t t = range.begin(); t < range.end(); ++t)
          least = std::min(least, deformationGradient(body, places, t).determinant());
        return least;
      },
      [](double a, double b) { return std::min(a, b); });
}

}  // namespace sinew
