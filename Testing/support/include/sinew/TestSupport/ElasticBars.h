#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

namespace sinew::test {

using NodeVectors = std::vector<Eigen::Vector3d>;

/// A bar of cubes, six tets each (Kuhn), from the origin along the positive axes.
inline TetMesh barMesh(const Eigen::Vector3i& cubes, double cube) {
  constexpr int kPaths[6][2] = {{1, 3}, {1, 5}, {2, 3},
                                {2, 6}, {4, 5}, {4, 6}};  // corners as bits of x, y, z
  TetMesh mesh;
  const Eigen::Vector3i points = cubes + Eigen::Vector3i::Ones();
  const auto node = [&](int i, int j, int k) { return i + points.x() * (j + points.y() * k); };
  for (int k = 0; k < points.z(); ++k)
    for (int j = 0; j < points.y(); ++j)
      for (int i = 0; i < points.x(); ++i) mesh.nodes.emplace_back(cube * Eigen::Vector3d(i, j, k));
  for (int k = 0; k < cubes.z(); ++k)
    for (int j = 0; j < cubes.y(); ++j)
      for (int i = 0; i < cubes.x(); ++i) {
        const auto corner = [&](int bits) {
          return node(i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2));
        };
        for (const auto& path : kPaths) {
          Tet tet{corner(0), corner(path[0]), corner(path[1]), corner(7)};
          const auto at = [&](int c) {
            return mesh.nodes[static_cast<std::size_t>(tet[static_cast<std::size_t>(c)])];
          };
          if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0) std::swap(tet[1], tet[2]);
          mesh.tets.push_back(tet);
        }
      }
  mesh.labels.assign(mesh.tets.size(), 1);
  mesh.kinds.assign(mesh.nodes.size(), NodeKind::Interior);
  return mesh;
}

/// A bar along z that is thickest in the middle, where it is twice as thick as at its ends.
inline TetMesh spindleMesh(const Eigen::Vector3i& cubes, double cube) {
  TetMesh mesh = barMesh(cubes, cube);
  const Eigen::Vector3d size = cube * cubes.cast<double>();
  for (Eigen::Vector3d& node : mesh.nodes) {
    const double thickness = (1 + std::sin(std::numbers::pi * node.z() / size.z())) / 2;
    node.head<2>() = size.head<2>() / 2 + thickness * (node - size / 2).head<2>();
  }
  return mesh;
}

/// Every component within +-size.
inline NodeVectors randomVectors(std::size_t nodes, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  NodeVectors vectors(nodes);
  for (Eigen::Vector3d& vector : vectors)
    for (double& component : vector) component = uniform(random);
  return vectors;
}

inline Eigen::Matrix3d randomMatrix(double size, unsigned seed) {
  const NodeVectors columns = randomVectors(3, size, seed);
  Eigen::Matrix3d matrix;
  matrix << columns[0], columns[1], columns[2];
  return matrix;
}

inline NodeVectors sum(const NodeVectors& a, const NodeVectors& b) {
  NodeVectors result(a.size());
  for (std::size_t n = 0; n < a.size(); ++n) result[n] = a[n] + b[n];
  return result;
}

/// Nodes moved by up to `share` of the cube of a bar.
inline NodeVectors shaken(const NodeVectors& places, double size, unsigned seed) {
  return sum(places, randomVectors(places.size(), size, seed));
}

inline Eigen::Vector3d total(const NodeVectors& vectors) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vector : vectors) result += vector;
  return result;
}

/// Sum of x cross f.
inline Eigen::Vector3d moment(const NodeVectors& places, const NodeVectors& forces) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < places.size(); ++n) result += places[n].cross(forces[n]);
  return result;
}

inline double inner(const NodeVectors& a, const NodeVectors& b) {
  double result = 0;
  for (std::size_t n = 0; n < a.size(); ++n) result += a[n].dot(b[n]);
  return result;
}

/// Sum of |f| and of |x||f|, against which momentum errors count.
inline double magnitude(const NodeVectors& forces) {
  double result = 0;
  for (const Eigen::Vector3d& force : forces) result += force.norm();
  return result;
}

}  // namespace sinew::test
