#include "sinew/Elasticity/HarmonicFibres.h"

#include "NodeSums.h"
#include "ShapeGradients.h"
#include "sinew/Elasticity/HarmonicField.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// 0 at the origin, 1 at the insertion, kWanted elsewhere.
std::vector<double> attachmentValues(const ElasticBody& body, const std::vector<std::int32_t>& origin,
                                     const std::vector<std::int32_t>& insertion) {
  std::vector<double> values(body.nodeCount(), kWanted);
  const auto attach = [&](const std::vector<std::int32_t>& nodes, double value, const std::string& name) {
    if (nodes.empty()) throw std::invalid_argument("harmonicFibres: there is no node at the " + name);
    for (const std::int32_t node : nodes) {
      if (node < 0 || static_cast<std::size_t>(node) >= body.nodeCount())
        throw std::invalid_argument("harmonicFibres: the " + name + " has node " + std::to_string(node) +
                                    ", the body " + std::to_string(body.nodeCount()) + " nodes");
      double& known = values[static_cast<std::size_t>(node)];
      if (!std::isnan(known) && known != value)
        throw std::invalid_argument("harmonicFibres: node " + std::to_string(node) +
                                    " is at the origin and at the insertion");
      known = value;
    }
  };
  attach(origin, 0, "origin");
  attach(insertion, 1, "insertion");
  return values;
}

}  // namespace

NodeVectors harmonicFibres(const ElasticBody& body, const std::vector<std::int32_t>& origin,
                           const std::vector<std::int32_t>& insertion) {
  const std::vector<double> field = harmonicField(body, attachmentValues(body, origin, insertion));
  NodeVectors fibres(body.tets.size(), Vector3d::Zero());
  forEachIndex(body.tets.size(), [&](std::size_t t) {
    const Eigen::Matrix<double, 3, 4> gradients = shapeGradients(body, t);
    Vector3d gradient = Vector3d::Zero();
    double largest = 0;
    for (int i = 0; i < 4; ++i) {
      gradient +=
          field[static_cast<std::size_t>(body.tets[t][static_cast<std::size_t>(i)])] * gradients.col(i);
      largest = std::max(largest, gradients.col(i).norm());
    }
    constexpr double kFlat = 1e-9;  // what the solver's tolerance leaves
    if (gradient.norm() > kFlat * largest) fibres[t] = gradient.normalized();
  });
  return fibres;
}

}  // namespace sinew
