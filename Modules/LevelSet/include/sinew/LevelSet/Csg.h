#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"

namespace sinew {

/// Constructive solid geometry on level sets of one lattice (METHOD [16]):
///     union  min(a, b),   intersection  max(a, b),   difference  max(a, -b);
/// beyond its samples a level set is +band. The result has the right zero set and the smaller of both bands,
/// but beside a crease it is no distance: redistance it before offset, smooth, opening or closing.
///
/// With a blend radius r > 0 a ball of radius r rolls along the crease, outside of a union and inside of an
/// intersection or difference, and what it cannot reach is filled or taken away: a fillet. With both surfaces
/// taken for planes, normals n_a and n_b, c = n_a.n_b, the ball's centre, where a = b = r, lies
///     d = (u - c v)/(1 - c^2) n_a + (v - c u)/(1 - c^2) n_b,   u = r - a, v = r - b
/// from a point, and
///     union  r - |d|,   |d|^2 = (2 u v + (u - v)^2/(1 - c))/(1 + c)
/// between the two lines of contact, where both coefficients are positive; min(a, b) elsewhere. In a valley
/// that is sharper than a right angle c = 0 stands in, as if the planes were square: the fillet is an arc of
/// an ellipse that touches each plane where the other one is r away. The other operations follow from the
/// complements. So the zero set differs from the sharp one only where both surfaces are nearer than r, and
/// joins it without an edge; surfaces that already run along each other stay, and a shape that meets itself
/// is itself; faces that look at each other across less than (2 - sqrt(2)) r grow together.
/// @param blend  mm, in [0, band]; exact for planes
/// @throws std::invalid_argument when a and b do not share their lattice, or blend is out of its range.
/// Cost: O(samples of the box of both), in parallel; the same bits for any number of threads.
DenseLevelSet unite(const DenseLevelSet& a, const DenseLevelSet& b, double blend = 0);
DenseLevelSet intersect(const DenseLevelSet& a, const DenseLevelSet& b, double blend = 0);
DenseLevelSet subtract(const DenseLevelSet& a, const DenseLevelSet& b, double blend = 0);

}  // namespace sinew
