#pragma once

#include <filesystem>

namespace sinew {

enum class FileKind { Segmentation, Mesh };

/// What a file holds: an image is told by its content, a mesh by its name.
/// @throws std::runtime_error naming the file when it is missing or neither
FileKind fileKind(const std::filesystem::path& file);

}  // namespace sinew
