#pragma once

#include "sinew/MeshIO/TissueMesh.h"

#include <filesystem>

namespace sinew {

/// The patient's axes that coordinates count along: to the left, the back and the head, or to the right, the
/// front and the head. The two differ by half a turn about the body's axis, so tets keep their orientation.
enum class Space { Lps, Ras };

struct WriteMeshOptions {
  Space space = Space::Lps;
  /// Say inside the file which space it is, as 3D Slicer reads it; .vtu and .vtp then hold text, which meshio
  /// and FEBio Studio refuse. Only millimetres are marked: Slicer knows no other unit.
  bool spaceTag = true;
  double perMm = 1;        ///< one mm in the file's unit: 1 for mm, 0.1 for cm, 0.001 for m
  bool material = false;   ///< .vtu: the labels once more as the array `material`, which MFEM reads
  bool quadratic = false;  ///< tets of ten nodes, where the format has them
};

/// Writes a mesh; the end of the file's name chooses the format, see meshFormats(). Labels without a region
/// are named `Segment_<label>`, in grey. The file appears under its name when it is complete. The same mesh
/// gives the same bytes.
/// @throws std::runtime_error naming the file when the format is unknown or the file cannot be written;
/// std::invalid_argument when labels or an array have not one value for each tet or node.
void writeMesh(const TissueMesh& mesh, const std::filesystem::path& file,
               const WriteMeshOptions& options = {});

}  // namespace sinew
