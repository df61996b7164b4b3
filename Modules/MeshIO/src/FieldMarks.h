#pragma once

#include "sinew/MeshIO/WriteMesh.h"

#include <vtkFieldData.h>

namespace sinew {

/// What a .vtu or .vtp says of itself in its field data:
/// - `SPACE`, one text, `LPS` or `RAS`: where 3D Slicer looks for it;
/// - `tissue_labels` (Int32) and `tissue_names` (text), a pair for every region.
/// Nothing with `spaceTag` off: meshio and FEBio Studio refuse text in field data.
void addMarks(const TissueMesh& mesh, const WriteMeshOptions& options, vtkFieldData* field);

/// As 3D Slicer takes it: text that holds `RAS`.
bool marksRas(vtkFieldData* field);

/// Labels and names, in grey; empty when the two arrays are not there or do not fit.
std::vector<TissueRegion> markedRegions(vtkFieldData* field);

}  // namespace sinew
