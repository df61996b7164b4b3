#include "VtuFile.h"

#include "FieldMarks.h"
#include "GuardedXmlReader.h"
#include "TissueGrid.h"
#include "VtkReading.h"
#include "XmlFile.h"

#include <vtkObjectFactory.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace sinew {
namespace {

/// VTK 9.1 leaves these pointers undefined unless it appends, and deletes them when the disk is full.
class VtuWriter : public vtkXMLUnstructuredGridWriter {
 public:
  static VtuWriter* New();
  vtkTypeMacro(VtuWriter, vtkXMLUnstructuredGridWriter)

      protected : VtuWriter() {
    NumberOfPointsPositions = NumberOfCellsPositions = nullptr;
  }
};
vtkStandardNewMacro(VtuWriter);

}  // namespace

void writeVtu(const TissueMesh& mesh, const std::filesystem::path& file, const WriteMeshOptions& options) {
  const auto grid = tissueGrid(mesh, options);
  addMarks(mesh, options, grid->GetFieldData());
  writeXml<VtuWriter>(grid, file);
}

TissueMesh readVtu(const std::filesystem::path& file, const ReadMeshOptions& options) {
  const auto reader = vtkSmartPointer<GuardedXmlReader<vtkXMLUnstructuredGridReader>>::New();
  reader->SetFileName(file.c_str());
  update(reader, file, "an unstructured grid");
  vtkUnstructuredGrid* grid = reader->GetOutput();
  return tissueMeshOf(grid, marksRas(grid->GetFieldData()), file, options);
}

}  // namespace sinew
