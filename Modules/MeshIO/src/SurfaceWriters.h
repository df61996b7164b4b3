#pragma once

#include "sinew/MeshIO/WriteMesh.h"

namespace sinew {

/// Writers of the tissues' surfaces, see tissueSurfaces, one after the other in one file, with `SPACE=LPS` or
/// `SPACE=RAS` where 3D Slicer looks for it. VTK's writers of .stl, .ply and .obj keep float coordinates, no
/// groups, and do not notice a disk that is full at the end; .vtp is VTK's.
/// @throws std::runtime_error saying what went wrong

/// Binary, float; the space in the header of 80 bytes.
/// Source: 3D Systems 1988, StereoLithography interface specification.
void writeStl(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

/// Binary, double; the space in a comment; `red`, `green`, `blue` and `label` of each vertex, since fewer
/// programs read them of faces, and tissues share no vertex. Source: Turk 1994, the PLY polygon file format.
void writePly(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

/// The space in a comment; a group for each tissue, named as it is, white space replaced by `_`.
/// Source: Wavefront, Advanced Visualizer manual, appendix B1.
void writeObj(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

/// VTK XML poly data with the cell arrays `labels` (Int32, active scalars) and `RGB` (three UInt8), and the
/// field data of addMarks.
void writeVtp(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options);

}  // namespace sinew
