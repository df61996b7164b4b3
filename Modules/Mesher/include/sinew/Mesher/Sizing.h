#pragma once

#include "sinew/Mesher/RedGreenLattice.h"
#include "sinew/Mesher/SignedDistance.h"

namespace sinew {

/// Where the lattice lies: x(p) = origin + halfCube * p, with p in half cubes of the finest level.
struct LatticeFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< mm
  double halfCube = 1;                               ///< mm
  Eigen::Vector3d position(Int3 p) const { return origin + halfCube * Eigen::Vector3d(p.x, p.y, p.z); }
};

struct SizingOptions {
  double edgeLength = 0;     ///< cube size asked for at the surface, mm, > 0
  double maxEdgeLength = 0;  ///< largest cube size, mm, >= edgeLength
  double minEdgeLength = 0;  ///< smallest cube size that the rules below may ask for, mm
  double curvature = 1.0;    ///< refine where cube size * (|k1| + |k2|) exceeds this; 0: never
  double tolerance = 0;      ///< refine where cube size^2 * max(|k1|, |k2|) / 8 exceeds this, mm; 0: never
  double thickness = 1.6;    ///< refine where the shape is thinner than this many cubes; 0: never
  int levels = 0;            ///< largest number of levels; 0: no limit
};

/// The block of the lattice and its levels for a shape.
struct LatticePlan {
  LatticeFrame frame;
  Int3 coarseCells;
  int levels = 1;
  int surfaceLevel = 0;  ///< level of the coarsest cubes at the surface: at first those of the edge length
  double cubeSize(int level) const { return 2 * frame.halfCube * (1 << (levels - 1 - level)); }
};

/// Level 0 has the largest cube that is edgeLength times a power of two; the block overhangs the shape's
/// bounds by two such cubes and more on every side, so that no star near the shape is clipped.
LatticePlan planLattice(const SignedDistance& phi, const SizingOptions& options);

/// Refines the lattice: cubes of edgeLength or less within one edge length of the surface, finer ones where
/// curvature, tolerance or thickness ask, the first two down to the resolution of phi (Teran et al. 2005,
/// section 5), below it only where the shape ends within `thickness` cubes below its surface, graded by the
/// hierarchy elsewhere; where much of the surface asks, all of it becomes finer and plan.surfaceLevel rises.
/// Closes the hierarchy. Cost: O(shape's surface / edgeLength^2 + bounds / band^3); parallel, the same for
/// any number of threads.
/// @return the finest level with tets
int refineToSize(RedGreenLattice& lattice, LatticePlan& plan, const SignedDistance& phi,
                 const SizingOptions& options);

}  // namespace sinew
