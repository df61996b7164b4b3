#include "sinew/Simulation/FibreField.h"

#include "sinew/Elasticity/HarmonicFibres.h"

#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// Unit vectors stay; what is next to nothing becomes zero.
void normalize(NodeVectors& fibres) {
  for (std::size_t t = 0; t < fibres.size(); ++t) {
    if (!fibres[t].allFinite())
      throw std::invalid_argument("the fibre of tet " + std::to_string(t) +
                                  " is no vector of finite numbers");
    const double length = fibres[t].norm();
    fibres[t] = length > 0 ? Vector3d(fibres[t] / length) : Vector3d::Zero();
  }
}

/// Sums at the nodes of the fibres around them.
NodeVectors nodeSums(const TetMesh& mesh, const NodeVectors& fibres) {
  NodeVectors sums(mesh.nodes.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < fibres.size(); ++t)
    for (const std::int32_t node : mesh.tets[t]) sums[static_cast<std::size_t>(node)] += fibres[t];
  return sums;
}

/// @return whether a tet was given a fibre
bool fillLayer(const TetMesh& mesh, NodeVectors& fibres) {
  const NodeVectors sums = nodeSums(mesh, fibres);
  bool any = false;
  for (std::size_t t = 0; t < fibres.size(); ++t) {
    if (!fibres[t].isZero()) continue;
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t node : mesh.tets[t]) sum += sums[static_cast<std::size_t>(node)];
    if (sum.isZero()) continue;
    fibres[t] = sum.normalized();
    any = true;
  }
  return any;
}

}  // namespace

NodeVectors filledFibres(const TetMesh& mesh, NodeVectors fibres) {
  if (fibres.size() != mesh.tets.size())
    throw std::invalid_argument(std::to_string(fibres.size()) + " fibres for " +
                                std::to_string(mesh.tets.size()) + " tets");
  normalize(fibres);
  while (fillLayer(mesh, fibres)) {
  }
  return fibres;
}

NodeVectors fibreField(const TetMesh& mesh, const Attachments& attachments) {
  return filledFibres(mesh, harmonicFibres(elasticBody(mesh), attachments.origin, attachments.insertion));
}

}  // namespace sinew
