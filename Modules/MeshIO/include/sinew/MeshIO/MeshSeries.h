#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew {

/// A mesh at one time.
struct SeriesMesh {
  double time = 0;   ///< s
  std::string file;  ///< relative to the folder of the series, UTF-8
};

/// Writes a series of mesh files as `.pvd`, which ParaView opens as one mesh that changes with time.
/// @throws std::runtime_error naming the file when it cannot be written
void writeMeshSeries(const std::vector<SeriesMesh>& series, const std::filesystem::path& file);

}  // namespace sinew
