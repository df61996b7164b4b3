#pragma once

#include <filesystem>

namespace sinew::dicom {

/// Refuses a DICOM file whose sequences lie in one another deeper than any real one's: DCMTK calls itself
/// once per level, until the stack ends. Reads tags and lengths only, of all uncompressed transfer syntaxes
/// and of deflated files.
/// @throws std::runtime_error naming the file
void requireShallowNesting(const std::filesystem::path& file);

}  // namespace sinew::dicom
