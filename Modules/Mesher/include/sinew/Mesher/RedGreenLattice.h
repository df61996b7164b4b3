#pragma once

#include "sinew/Mesher/BccLattice.h"
#include "sinew/Mesher/LatticeNodeSet.h"
#include "sinew/Mesher/RedGreen.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sinew {

/// A leaf of the hierarchy: a red tet without bisected edges, or a green child.
struct LatticeTet {
  std::array<Int3, 4> nodes;  ///< half cubes of the finest level, positive order
  int level;                  ///< of the red tet, or of the green child's red parent
  bool green;
};

/// A red tet of a level.
struct LevelTet {
  int level;
  BccTet tet;
};

/// The red-green hierarchy on a block of BCC cubes (Teran et al. 2005, section 4).
///
/// Every node that is new on level l + 1 is the midpoint of exactly one edge of level l. So the set of nodes
/// is the whole state: an edge is bisected when its midpoint is in the set, a red tet is refined when all its
/// six edges are. A red tet exists when its ancestors are refined; what is neither whole nor refined is
/// green.
class RedGreenLattice {
 public:
  /// @param coarseCells  cubes of level 0 along each axis, all of whose tets exist
  /// @param levels       1: no refinement
  RedGreenLattice(Int3 coarseCells, int levels);

  int levels() const { return levels_; }
  Int3 coarseCells() const { return coarseCells_; }

  /// Asks for the red refinement of a tet; its ancestors follow in close().
  void refine(int level, const BccTet& tet) { refine({{level, tet}}); }
  /// Many at once, in parallel.
  void refine(const std::vector<LevelTet>& tets);
  bool isRefined(int level, const BccTet& tet) const { return bisectedEdges(level, tet) == kAllEdges; }
  /// The 6-bit set of bisected edges of a tet of a level below the finest.
  unsigned bisectedEdges(int level, const BccTet& tet) const;

  /// Restores the hierarchy: only allowed patterns, all tets around a bisected edge exist, and numbers the
  /// nodes. Cost: O(new nodes), parallel; the same for any number of threads. @throws std::logic_error when
  /// the refinement reaches the border of the block.
  void close();

  const LatticeNodeSet& nodes() const { return nodes_; }

  /// The twelve tets of a cube of level 0. Tets reach into neighbouring cubes: only cubes 1 .. n - 2 are
  /// complete.
  static std::array<BccTet, 12> coarseTets(Int3 cell);

  /// Calls emit(LatticeTet) for the leaves below one tet; descends only where enter(level, nodes in finest
  /// half cubes).
  template <class Enter, class Emit>
  void forEachLeaf(int level, const BccTet& tet, const Enter& enter, const Emit& emit) const {
    std::array<Int3, 4> nodes = bccNodes(tet);
    for (Int3& p : nodes) p = p << (levels_ - 1 - level);
    if (!enter(level, nodes)) return;
    const unsigned mask = level + 1 < levels_ ? bisectedEdges(level, tet) : 0;
    if (mask == kAllEdges) {
      for (const BccTet& child : redChildren(tet)) forEachLeaf(level + 1, child, enter, emit);
    } else if (mask == 0) {
      emit(LatticeTet{nodes, level, false});
    } else {
      emitGreen(level, nodes, mask, emit);
    }
  }

 private:
  template <class Emit>
  static void emitGreen(int level, const std::array<Int3, 4>& nodes, unsigned mask, const Emit& emit) {
    const GreenPattern& pattern = kGreenPatterns[mask];
    for (int c = 0; c < pattern.count; ++c) {
      LatticeTet child{{}, level, true};
      for (int v = 0; v < 4; ++v) {
        const int point = pattern.tets[c][v];
        if (point < 4) {
          child.nodes[v] = nodes[point];
        } else {
          const Int3 sum = nodes[kTetEdges[point - 4][0]] + nodes[kTetEdges[point - 4][1]];
          child.nodes[v] = {sum.x / 2, sum.y / 2, sum.z / 2};
        }
      }
      emit(child);
    }
  }

  /// Edges of a tet, as a bit set, whose midpoints shall be in the set.
  struct Bisection {
    LevelTet at;
    unsigned edges;
  };
  /// Puts the midpoints of bisectionAt(i), i < count, into the set and what is new among them into fresh_.
  template <class BisectionAt>
  void bisect(std::size_t count, const BisectionAt& bisectionAt);
  /// What the closure asks for at the tets around a midpoint of a level.
  void close(int level, Int3 midpoint, std::vector<Bisection>& wanted) const;
  void insertCoarseNodes();
  /// The outermost cubes stay whole, so that every tet around a bisected edge lies in the block.
  void requireInside(Int3 p) const;

  Int3 coarseCells_;
  int levels_;
  LatticeNodeSet nodes_;
  std::vector<std::vector<Int3>>
      fresh_;  ///< per level: midpoints not yet closed, in half cubes of the next level
};

}  // namespace sinew
