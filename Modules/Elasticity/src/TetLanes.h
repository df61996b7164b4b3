#pragma once

#include "sinew/Elasticity/ElasticBody.h"

#include <array>

namespace sinew {

/// Some tets side by side, so that loops over them become vector instructions: a row per number of a tet.
struct TetLanes {
  static constexpr std::size_t kTets = 16;
  using Row = std::array<double, kTets>;
  using Edges = std::array<Row, 9>;  ///< x, y, z of node 1 minus node 0, then of nodes 2 and 3

  /// @param tetOf  lane -> tet of the body
  template <class TetOf>
  static void gather(const ElasticBody& body, const TetOf& tetOf, const NodeVectors& places, Edges& edges) {
    for (std::size_t lane = 0; lane < kTets; ++lane) {
      const Tet& tet = body.tets[tetOf(lane)];
      const double* x0 = places[static_cast<std::size_t>(tet[0])].data();
      for (std::size_t c = 0; c < 3; ++c) {
        const double* x = places[static_cast<std::size_t>(tet[c + 1])].data();
        for (std::size_t axis = 0; axis < 3; ++axis) edges[3 * c + axis][lane] = x[axis] - x0[axis];
      }
    }
  }
};

}  // namespace sinew
