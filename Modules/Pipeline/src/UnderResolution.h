#pragma once

#include "sinew/Pipeline/MeshTissues.h"

#include <string>

namespace sinew {

/// The option that meshes a tissue with another edge length, as one types it in a shell, with two digits:
/// `--size 'NAME=0.42mm'`.
/// @param edge  mm
std::string sizeOption(const std::string& tissue, double edge);

/// What tells that the lattice was too coarse for a tissue, and the option to change: pieces lost, another
/// topology than the level set's and the widest place where that is so, or a volume more than 5 % off the
/// level set's. Empty when nothing does.
/// @param report  of a mesh, measured
std::string underResolution(const TissueReport& report);

}  // namespace sinew
