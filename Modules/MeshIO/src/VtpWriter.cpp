#include "FieldMarks.h"
#include "Regions.h"
#include "SurfaceWriters.h"
#include "TissueSurfaces.h"
#include "XmlFile.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace sinew {
namespace {

/// VTK 9.1 leaves these pointers undefined unless it appends, and deletes them when the disk is full.
class VtpWriter : public vtkXMLPolyDataWriter {
 public:
  static VtpWriter* New();
  vtkTypeMacro(VtpWriter, vtkXMLPolyDataWriter)

      protected : VtpWriter() {
    NumberOfPointsPositions = nullptr;
    NumberOfVertsPositions = NumberOfLinesPositions = NumberOfStripsPositions = NumberOfPolysPositions =
        nullptr;
  }
};
vtkStandardNewMacro(VtpWriter);

vtkSmartPointer<vtkPolyData> polyDataOf(const std::vector<TissueSurface>& surfaces) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  const auto polygons = vtkSmartPointer<vtkCellArray>::New();
  const auto labels = vtkSmartPointer<vtkTypeInt32Array>::New();
  labels->SetName("labels");
  const auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  for (const TissueSurface& tissue : surfaces) {
    const vtkIdType first = points->GetNumberOfPoints();
    for (const Eigen::Vector3d& node : tissue.surface.nodes) points->InsertNextPoint(node.data());
    for (const auto& [a, b, c] : tissue.surface.triangles)
      polygons->InsertNextCell({first + a, first + b, first + c});
    for (std::size_t t = 0; t < tissue.surface.triangles.size(); ++t) {
      labels->InsertNextValue(tissue.region->label);
      colors->InsertNextTypedTuple(toBytes(tissue.region->color).data());
    }
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetCellData()->SetScalars(labels);
  data->GetCellData()->AddArray(colors);
  return data;
}

}  // namespace

void writeVtp(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options) {
  const auto data = polyDataOf(tissueSurfaces(mesh, options));
  addMarks(mesh, options, data->GetFieldData());
  writeXml<VtpWriter>(data, file);
}

}  // namespace sinew
