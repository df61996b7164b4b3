#pragma once

#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/Sizing.h"

#include <algorithm>

namespace sinew::test {

/// The lattice around a shape, as the candidate is chosen from it.
struct Background {
  LatticeMesh mesh;
  NodeStars stars;
};

inline Background backgroundOf(const SignedDistance& phi, double edgeLength) {
  const SizingOptions options{.edgeLength = edgeLength,
                              .maxEdgeLength = 8 * edgeLength,
                              .minEdgeLength = std::min(phi.resolution(), edgeLength)};
  LatticePlan plan = planLattice(phi, options);
  RedGreenLattice lattice(plan.coarseCells, plan.levels);
  refineToSize(lattice, plan, phi, options);
  Background b{latticeMesh(lattice, plan, phi), {}};
  b.stars = nodeStars(b.mesh.positions.size(), b.mesh.tets);
  return b;
}

}  // namespace sinew::test
