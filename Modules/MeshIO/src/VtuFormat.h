#pragma once

#include "sinew/MeshIO/VtuFile.h"
#include "sinew/MeshIO/WriteMesh.h"

namespace sinew {

/// `write` and `read` of .vtu in the table of formats.
void writeVtuFormat(const TissueMesh& mesh, const std::filesystem::path& file,
                    const WriteMeshOptions& options);
TissueMesh readVtuFormat(const std::filesystem::path& file);

}  // namespace sinew
