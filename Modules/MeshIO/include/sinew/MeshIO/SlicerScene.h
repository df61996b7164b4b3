#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// A mesh in a scene. Files are relative to the scene's folder.
struct SceneModel {
  std::filesystem::path file;
  std::string name;                            ///< any characters
  std::array<double, 3> color{0.5, 0.5, 0.5};  ///< RGB in 0..1
  double opacity = 1;
  /// A colour table (.ctbl) by which the cell array `labels` is coloured, instead of all in `color`: for a
  /// mesh of several tissues.
  std::optional<std::filesystem::path> colorTable = std::nullopt;
};

struct SceneSegmentation {
  std::filesystem::path file;  ///< .seg.nrrd
  std::string name;
};

/// What 3D Slicer shows when a user drops the scene onto it.
struct SlicerScene {
  std::vector<SceneModel> models;
  std::optional<SceneSegmentation> segmentation = std::nullopt;
  Space space = Space::Lps;  ///< of the meshes; a mark inside of a file wins
};

/// Writes a scene as `.mrml`. Characters that XML cannot hold, in names, become `?`; file names are encoded
/// as 3D Slicer decodes them.
/// @throws std::runtime_error naming the file when it cannot be written.
/// Source: 3D Slicer, Libs/MRML/Core: vtkMRMLScene, vtkMRMLStorageNode, vtkMRMLNode::URLEncodeString.
void writeSlicerScene(const SlicerScene& scene, const std::filesystem::path& file);

}  // namespace sinew
