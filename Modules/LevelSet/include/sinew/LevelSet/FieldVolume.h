#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// Part of a box that lies in a half space.
/// @param distance  signed distance of the box centre to the plane, negative inside
/// @param normal  unit normal of the plane
/// @param edges  edge lengths of the box
/// @return in [0, 1].  Source: Scardovelli, Zaleski 2000.
double halfSpaceFraction(double distance, const Eigen::Vector3d& normal, const Eigen::Vector3d& edges);

/// Volume of phi < level for a signed distance phi, better than voxel accuracy: every voxel near the surface
/// counts with the part that the half space  d + n.x < level  leaves of it, with d the voxel's mean of phi,
///     d = phi + sum_a h_a^2/24 phi_aa,   n = grad phi / |grad phi|.
/// @param spacing  mm
/// @return mm^3.  Cost: O(samples), in parallel; the same bits for any number of threads.
double fieldVolume(const DenseField& phi, const Eigen::Vector3d& spacing, double level = 0);

/// The level in [lowest, highest] with fieldVolume(phi, spacing, level) = volume, by the secant rule from
/// level 0; the best one found when the search ends before the volume is met to 1e-5.
/// @param phi  a signed distance, exact at least one voxel's diagonal beyond the two bounds
/// @param lowest,highest  mm, lowest <= 0 <= highest
/// @return mm.  Cost: a few times fieldVolume.
double volumeKeepingLevel(const DenseField& phi, const Eigen::Vector3d& spacing, double volume, double lowest,
                          double highest);

}  // namespace sinew
