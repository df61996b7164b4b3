#include "FieldMarks.h"

#include "MeshFormatTable.h"
#include "VtkArrays.h"

#include <vtkIntArray.h>
#include <vtkTypeInt32Array.h>

#include <array>

namespace sinew {
namespace {

constexpr const char *kSpace = "SPACE", *kTissueNames = "tissue_names", *kTissueLabels = "tissue_labels";

vtkStringArray* texts(vtkFieldData* field, const char* name) {
  return vtkStringArray::SafeDownCast(field->GetAbstractArray(name));
}

}  // namespace

void addMarks(const TissueMesh& mesh, const WriteMeshOptions& options, vtkFieldData* field) {
  if (!options.spaceTag) return;
  if (saysSpace(options))
    field->AddArray(textArray(kSpace, std::array<std::string, 1>{toString(options.space)}));
  std::vector<std::string> names;
  const auto labels = vtkSmartPointer<vtkTypeInt32Array>::New();
  labels->SetName(kTissueLabels);
  for (const TissueRegion& region : mesh.regions) {
    names.push_back(region.name);
    labels->InsertNextValue(region.label);
  }
  field->AddArray(labels);
  field->AddArray(textArray(kTissueNames, names));
}

bool marksRas(vtkFieldData* field) {
  vtkStringArray* space = texts(field, kSpace);
  return space != nullptr && space->GetNumberOfValues() > 0 &&
         space->GetValue(0).find("RAS") != std::string::npos;
}

std::vector<TissueRegion> markedRegions(vtkFieldData* field) {
  vtkStringArray* names = texts(field, kTissueNames);
  auto* labels = vtkIntArray::SafeDownCast(field->GetAbstractArray(kTissueLabels));
  if (names == nullptr || labels == nullptr || names->GetNumberOfValues() != labels->GetNumberOfValues())
    return {};
  std::vector<TissueRegion> regions;
  for (vtkIdType r = 0; r < labels->GetNumberOfValues(); ++r)
    regions.push_back({labels->GetValue(r), names->GetValue(r)});
  return regions;
}

}  // namespace sinew
