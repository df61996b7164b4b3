#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <span>
#include <string_view>

namespace sinew {

/// What a program wants of mesh files.
struct MeshPreset {
  std::string_view name;       ///< of the program, in lower case
  std::string_view extension;  ///< of the format that it reads best, one of meshFormats()
  WriteMeshOptions options;
  bool onlyMm = false;  ///< it takes every file for millimetres
};

std::span<const MeshPreset> meshPresets();

/// nullptr for a name that none has.
const MeshPreset* findMeshPreset(std::string_view name);

}  // namespace sinew
