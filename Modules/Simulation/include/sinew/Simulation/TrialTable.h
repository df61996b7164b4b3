#pragma once

#include "sinew/Simulation/MeshTrial.h"

#include <string>
#include <vector>

namespace sinew {

/// A trial of a mesh, and what to call the mesh.
struct NamedTrial {
  std::string name;
  TrialReport report;
};

/// The frames of trials as CSV: a line of titles with units, then one line for each frame. Numbers are exact
/// and the same in every locale.
std::string trialTable(const std::vector<NamedTrial>& trials);

/// How trials are ranked: those that stopped come before those that did not, the earlier first; then the one
/// with the larger worst aspect ratio of any tet at any time. @return indices, worst to best
std::vector<std::size_t> worstToBest(const std::vector<NamedTrial>& trials);

}  // namespace sinew
