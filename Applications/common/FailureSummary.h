#pragma once

#include "sinew/Pipeline/MeshTissues.h"

namespace sinew {

/// Which tissues failed, as far as their names fit in a line; empty when none did.
std::string failureSummary(const std::vector<TissueReport>& reports);

}  // namespace sinew
