#pragma once

#include "sinew/Simulation/MeshTrial.h"

namespace sinew {

/// Fills the report's extremes and its verdict from its frames, its stop and its completeness.
void judge(const TrialOptions& options, TrialReport& report);

}  // namespace sinew
