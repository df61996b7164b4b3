#pragma once

#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>

namespace sinew {

/// A mesh as VTK has it, in the file's space and unit; it shares memory with the mesh, which has to outlive
/// it. Cell arrays: `labels` (Int32, active scalars), `RGB` (three UInt8 of the tissue's colour: 3D Slicer
/// shows the first cell array of that kind), `material` where asked for, then the mesh's own (Float32).
vtkSmartPointer<vtkUnstructuredGrid> tissueGrid(const TissueMesh& mesh, const WriteMeshOptions& options);

/// The tets of a grid with their labels; names from the field data, colours from `RGB`.
/// @param ras   whether the file marks its coordinates as RAS
/// @param file  for messages. @throws std::runtime_error naming it
TissueMesh tissueMeshOf(vtkUnstructuredGrid* grid, bool ras, const std::filesystem::path& file,
                        const ReadMeshOptions& options);

}  // namespace sinew
