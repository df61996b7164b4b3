#pragma once

#include "sinew/MeshIO/TissueMesh.h"
#include "sinew/TestSupport/LatticeMesh.h"

#include <string>

namespace sinew::test {

/// Two tissues that share nodes: the left and the right half of a block, with labels 7 and 3.
inline TissueMesh twoHalves() {
  TissueMesh mesh;
  mesh.mesh = bccBlock({4, 3, 3});
  for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t) {
    double sum = 0;
    for (const std::int32_t node : mesh.mesh.tets[t]) sum += mesh.mesh.nodes[node].x();
    mesh.mesh.labels[t] = sum / 4 < 2 ? 7 : 3;
  }
  for (Eigen::Vector3d& x : mesh.mesh.nodes) x = x * (1.0 / 3) + Eigen::Vector3d(-123.456, 1e-5, 700);
  mesh.regions = {{7, "left half", {1, 0, 0}}, {3, "right half", {0, 0, 1}}};
  return mesh;
}

/// One tet for each name, labels from 1.
inline TissueMesh namedTets(const std::vector<std::string>& names) {
  TissueMesh mesh;
  for (std::int32_t r = 0; r < std::ssize(names); ++r) {
    const Eigen::Vector3d corner(2 * r, 0, 0);
    for (const Eigen::Vector3d& x : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                     Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
      mesh.mesh.nodes.push_back(corner + x);
    mesh.mesh.tets.push_back({4 * r, 4 * r + 1, 4 * r + 2, 4 * r + 3});
    mesh.mesh.labels.push_back(r + 1);
    mesh.regions.push_back({r + 1, names[r]});
  }
  mesh.mesh.kinds.assign(mesh.mesh.nodes.size(), NodeKind::Boundary);
  return mesh;
}

/// Names that no format takes as they are: quotes, umlauts, spaces and slashes, 200 characters, the same but
/// for the case, none at all, what XML and .inp take for their own, and a character that a cut must not
/// halve.
inline std::vector<std::string> hardNames() {
  return {"a \"quoted\" 'name'",
          "M\u00fcller/Gro\u00df",
          std::string(200, 'x'),
          std::string(199, 'x') + "y",
          "muscle",
          "Muscle",
          "muscle",
          "",
          "",
          "<a>&b;--",
          "*ELEMENT, TYPE=C3D4",
          "7 up",
          "Eall",
          "line\nbreak\tand tab",
          "bad \xff\xfe bytes",
          std::string(31, 'z') + "\u00fc" + std::string(94, 'z') + "\u00fc"};
}

}  // namespace sinew::test
