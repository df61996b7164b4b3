#pragma once

#include <span>
#include <string>
#include <string_view>

namespace sinew {

enum class MeshContent { Volume, Surface };

/// A kind of mesh file, chosen by the end of its name.
struct MeshFormat {
  std::string_view extension;  ///< with the dot, lower case
  std::string_view name;       ///< for help texts
  MeshContent content;         ///< the tets, or the boundary of each tissue as triangles
  bool readable;               ///< readMesh takes it, too
  bool quadratic;              ///< has tets of ten nodes
  bool arrays;                 ///< has the arrays of a mesh
};

/// All of them, the default first.
std::span<const MeshFormat> meshFormats();

/// The format of a file by its name, upper case allowed; nullptr when there is none.
const MeshFormat* findMeshFormat(std::string_view fileName);

/// The extensions, for messages: `.vtu, .vtk and .msh`.
/// @param only  those of which this is true: `&MeshFormat::readable`
std::string meshExtensions(bool MeshFormat::*only = nullptr);

}  // namespace sinew
