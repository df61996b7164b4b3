#pragma once

#include "sinew/LevelSet/LevelSet.h"

#include <filesystem>
#include <string>

namespace sinew {

/// Writes a level set as OpenVDB's .vdb: a float grid of class level set in LPS mm, named `name`.
/// @throws std::runtime_error naming the file.
void writeVdb(const LevelSet& levelSet, const std::string& name, const std::filesystem::path& file);

/// Reads the first float grid of class level set.
/// @throws std::runtime_error naming the file: no OpenVDB file, damaged, no level set in it, or one whose
/// samples are not isotropic or sheared.
LevelSet readVdb(const std::filesystem::path& file);

}  // namespace sinew
