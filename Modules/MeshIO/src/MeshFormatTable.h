#pragma once

#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"

namespace sinew {

/// A row of the one table of formats, in MeshFormats.cpp.
struct MeshFormatRow {
  MeshFormat format;
  /// Writes the whole file, under a temporary name. The mesh is as the caller gave it, LPS mm, checked and
  /// with a region for every label; `inFile` gives the coordinates to write.
  /// @throws std::runtime_error saying what went wrong; writeMesh names the file and removes it
  void (*write)(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);
  /// The tets, their labels and regions; nullptr where `format.readable` is false. readMesh adds the rest.
  /// @throws std::runtime_error naming the file
  TissueMesh (*read)(const std::filesystem::path& file, const ReadMeshOptions& options);
};

/// nullptr when there is none.
const MeshFormatRow* findMeshFormatRow(std::string_view fileName);

/// A point of the mesh in the space and unit of the file.
inline Eigen::Vector3d inFile(const Eigen::Vector3d& x, const WriteMeshOptions& options) {
  const double turn = options.space == Space::Ras ? -1 : 1;
  return options.perMm * Eigen::Vector3d(turn * x.x(), turn * x.y(), x.z());
}

/// The values of an array along the axes of the file, or back.
inline std::vector<float> turned(const MeshArray& array, Space space) {
  std::vector<float> values = array.values;
  if (array.components == 3 && space == Space::Ras)
    for (std::size_t i = 0; i < values.size(); i += 3) {
      values[i] = -values[i];
      values[i + 1] = -values[i + 1];
    }
  return values;
}

/// Whether the file is to say which space it is in.
inline bool saysSpace(const WriteMeshOptions& options) { return options.spaceTag && options.perMm == 1; }

inline const char* toString(Space space) { return space == Space::Ras ? "RAS" : "LPS"; }

}  // namespace sinew
