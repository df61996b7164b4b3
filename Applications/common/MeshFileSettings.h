#pragma once

#include "Option.h"
#include "sinew/MeshIO/WriteMesh.h"

namespace sinew {

/// What a person chooses about mesh files, in `sinew mesh` and `sinew convert`. Empty texts: as the preset
/// says, or else the first choice.
struct MeshFileSettings {
  std::string preset;  ///< for which program the files are
  std::string space;   ///< LPS or RAS
  std::string unit;    ///< mm, cm or m
  bool noSpaceTag = false;
  bool quadratic = false;
};

/// The options of `settings`, as rows; the settings must outlive them.
std::vector<Option> meshFileOptions(MeshFileSettings& settings);

/// @param file  name of a file to write
/// @throws CLI::ValidationError when their format, or the program of the preset, cannot hold what is chosen
void checkMeshFiles(const MeshFileSettings& settings, std::string_view file);

/// What writeMesh takes: the preset, and over it what was chosen one by one.
WriteMeshOptions resolved(const MeshFileSettings& settings);

/// The extension that the preset asks for, else that of the first format.
std::string_view standardExtension(const MeshFileSettings& settings);

/// `--format`: the extensions without their dots.
Option formatOption(std::string& format);

/// Says inside the file which unit it is in, for reports: `mm`, `cm` or `m`.
std::string_view unitOf(const WriteMeshOptions& options);

}  // namespace sinew
