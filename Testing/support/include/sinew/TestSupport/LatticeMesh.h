#pragma once

#include "sinew/Mesher/TetMesh.h"

#include <functional>
#include <map>

namespace sinew::test {

/// The orbit of one BCC tet inside a block of `cubes` unit cubes: tets around every inner cube face, two cube
/// centres and one edge of the face each. Volume 1/12, aspect ratio sqrt 2, dihedrals 60 and 90 degrees.
/// @param keep  tells from a tet's centroid whether it stays; nodes without a tet are dropped
/// Labels are 1; kinds are all Boundary (not computed).
inline TetMesh bccBlock(const Eigen::Vector3i& cubes,
                        const std::function<bool(const Eigen::Vector3d& centroid)>& keep = {}) {
  TetMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> known;  // doubled coordinates -> node
  const auto node = [&](const Eigen::Vector3i& doubled) {
    const auto [it, fresh] =
        known.try_emplace({doubled[0], doubled[1], doubled[2]}, std::int32_t(mesh.nodes.size()));
    if (fresh) mesh.nodes.push_back(doubled.cast<double>() / 2);
    return it->second;
  };
  const auto add = [&](const std::array<Eigen::Vector3i, 4>& p) {
    const Eigen::Vector3i doubledSum = p[0] + p[1] + p[2] + p[3];
    if (keep && !keep(doubledSum.cast<double>() / 8)) return;
    mesh.tets.push_back({node(p[0]), node(p[1]), node(p[2]), node(p[3])});
  };
  for (int k = 0; k < cubes[2]; ++k)
    for (int j = 0; j < cubes[1]; ++j)
      for (int i = 0; i < cubes[0]; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          const Eigen::Vector3i cube(i, j, k), n = Eigen::Vector3i::Unit(axis);
          if (cube[axis] + 1 >= cubes[axis]) continue;
          const Eigen::Vector3i u = Eigen::Vector3i::Unit((axis + 1) % 3),
                                v = Eigen::Vector3i::Unit((axis + 2) % 3);
          const Eigen::Vector3i centre = 2 * cube + Eigen::Vector3i::Ones(), corner = 2 * (cube + n);
          const std::array<Eigen::Vector3i, 4> ring{corner, corner + 2 * u, corner + 2 * u + 2 * v,
                                                    corner + 2 * v};
          for (int e = 0; e < 4; ++e) add({centre, ring[e], ring[(e + 1) % 4], centre + 2 * n});
        }
  mesh.labels.assign(mesh.tets.size(), 1);
  mesh.kinds.assign(mesh.nodes.size(), NodeKind::Boundary);
  return mesh;
}

}  // namespace sinew::test
