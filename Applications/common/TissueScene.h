#pragma once

#include "sinew/Pipeline/MeshTissues.h"

namespace sinew {

inline constexpr const char* kSceneName = "scene.mrml";

/// Whether 3D Slicer reads meshes written so, and a scene makes sense: in millimetres, in a format that it
/// knows.
bool hasScene(const MeshTissuesOptions& options);

/// Writes a scene that opens every tissue that was meshed in 3D Slicer, with its name and colour.
/// @param file     beside the meshes
/// @throws std::runtime_error naming the file when it cannot be written
void writeTissueScene(const std::vector<TissueReport>& tissues, const std::filesystem::path& file,
                      const WriteMeshOptions& writing);

}  // namespace sinew
