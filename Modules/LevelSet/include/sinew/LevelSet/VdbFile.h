#pragma once

#include "sinew/LevelSet/LevelSet.h"

#include <filesystem>
#include <string>

namespace sinew {

/// Writes a level set as OpenVDB's .vdb: a float grid of class level set in LPS mm, named `name`.
/// @throws std::runtime_error naming the file.
void writeVdb(const LevelSet& levelSet, const std::string& name, const std::filesystem::path& file);

/// Reads the first float grid of class level set; its band is the grid's background.
/// @throws std::runtime_error naming the file: no OpenVDB file, damaged, no level set in it, one without a
/// surface or in a box of more than 2^31 samples, or one whose samples are stretched, sheared or mirrored.
/// The format has no check sums: damage goes unseen where it leaves possible numbers, and where OpenVDB 10
/// trusts a size that is wrong it ends the program (2 of 1200 files with one wrong byte). Read no files of
/// strangers.
LevelSet readVdb(const std::filesystem::path& file);

}  // namespace sinew
