#pragma once

#include "sinew/Mesher/LatticeMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sinew {

struct CandidateOptions {
  double minInsideFraction =
      0.25;            ///< every edge of an enveloped node is at least this far inside, in [0, 0.5]
  int maxPasses = 12;  ///< of enveloping, before the rest is mended by giving up nodes; 0: no repair at all
};

/// The subset of a lattice mesh that will be pushed onto the surface.
struct Candidate {
  std::vector<std::uint8_t> enveloped;  ///< per lattice node: all its tets are kept
  std::vector<std::uint8_t> keep;       ///< per lattice tet
  int passes = 0;                       ///< repair passes taken
  std::int64_t added = 0;               ///< nodes enveloped by the repair
  std::int64_t released = 0;            ///< nodes given up by it, where enveloping came to no end
  std::int64_t violations = 0;          ///< what is left: 0 but without repair
};

/// Keeps all tets incident on nodes that are inside with every edge at least minInsideFraction inside by
/// linear interpolation (Molino et al. 2003, enveloping rule),
///
///     phi_j <= -(1 - f) / f  phi_i   for every neighbour j of i, phi_i < 0,      f = minInsideFraction,
///
/// then repairs until the kept set obeys T1-T3 and has no interior face with three boundary nodes
/// (Teran et al. 2005, section 6): nodes at violations are enveloped, of two or three the one that adds least
/// outside material. Where this comes to no end (a thin rough sheet), nodes are given up instead, which does:
/// the set only shrinks. No kept tet can have four boundary nodes. Cost: O(tets).
Candidate selectCandidate(const LatticeMesh& mesh, const NodeStars& stars,
                          const CandidateOptions& options = {});

/// The kept tets as a mesh with its node kinds; `latticeNodes`, if given, receives the lattice node of every
/// mesh node.
TetMesh extractMesh(const LatticeMesh& mesh, const std::vector<std::uint8_t>& keep, std::int32_t label,
                    std::vector<std::int32_t>* latticeNodes = nullptr);

}  // namespace sinew
