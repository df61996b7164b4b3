#pragma once

#include "sinew/Mesher/Candidate.h"
#include "sinew/Mesher/LatticeMesh.h"
#include "sinew/Mesher/Sizing.h"

#include <algorithm>

namespace sinew::test {

/// A lattice that is refined to a shape, and what matters of it.
struct Background {
  LatticePlan plan;
  RedGreenLattice lattice;
  LatticeMesh mesh;
  NodeStars stars;
};

inline Background backgroundOf(const SignedDistance& phi, double edgeLength, double maxOverEdge = 8) {
  const SizingOptions options{.edgeLength = edgeLength,
                              .maxEdgeLength = maxOverEdge * edgeLength,
                              .minEdgeLength = std::min(phi.resolution(), edgeLength)};
  LatticePlan plan = planLattice(phi, options);
  RedGreenLattice lattice(plan.coarseCells, plan.levels);
  refineToSize(lattice, plan, phi, options);
  LatticeMesh mesh = latticeMesh(lattice, plan, phi);
  NodeStars stars = nodeStars(mesh.positions.size(), mesh.tets);
  return {plan, std::move(lattice), std::move(mesh), std::move(stars)};
}

}  // namespace sinew::test
