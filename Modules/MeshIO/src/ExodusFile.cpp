#include "ExodusFile.h"

#include "CoordinatesNote.h"
#include "LegalNames.h"
#include "SolverMesh.h"
#include "VtkErrorTrap.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataSet.h>
#include <vtkExodusIIWriter.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <fstream>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr NameRule kNames{.maxBytes = 32, .refused = ""};
constexpr const char* kBlockId = "block";

/// A tissue's tets on their own nodes.
vtkSmartPointer<vtkUnstructuredGrid> blockOf(const SolverMesh& mesh, std::size_t part,
                                             std::vector<vtkIdType>& place) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const std::int32_t node : mesh.parts()[part].nodes)
    place[node] = points->InsertNextPoint(mesh.node(static_cast<std::size_t>(node)).data());

  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  std::vector<vtkIdType> cell;
  for (const std::int32_t t : mesh.parts()[part].tets) {
    cell.clear();
    for (const std::int32_t node : mesh.tet(static_cast<std::size_t>(t))) cell.push_back(place[node]);
    grid->InsertNextCell(mesh.quadratic() ? VTK_QUADRATIC_TETRA : VTK_TETRA, std::ssize(cell), cell.data());
  }
  const auto ids = vtkSmartPointer<vtkIntArray>::New();
  ids->SetName(kBlockId);
  ids->SetNumberOfValues(grid->GetNumberOfCells());
  ids->FillValue(mesh.tags()[part]);
  grid->GetCellData()->AddArray(ids);
  return grid;
}

/// VTK gives the file a title with the date, so that no two are the same; another takes its place.
void replaceTitle(const fs::path& file, std::string title) {
  constexpr std::string_view kVtkTitle = "Created by vtkExodusIIWriter, ";
  constexpr std::size_t kDate = 25, kHeader = 4096;
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  std::string header(kHeader, '\0');
  stream.read(header.data(), std::ssize(header));
  stream.clear();
  const std::size_t at = header.find(kVtkTitle);
  title.resize(kVtkTitle.size() + kDate, ' ');
  if (at != header.npos) stream.seekp(static_cast<std::streamoff>(at)).write(title.data(), std::ssize(title));
  if (!stream.flush()) throw std::runtime_error("the file is incomplete; is the disk full?");
}

}  // namespace

void writeExodus(const TissueMesh& tissues, const fs::path& file, const WriteMeshOptions& options) {
  const SolverMesh mesh(tissues, options);
  const std::vector<std::string> names = legalNames(mesh.regions(), kNames);
  const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  std::vector<vtkIdType> place(mesh.nodeCount());
  for (unsigned p = 0; p < names.size(); ++p) {
    blocks->SetBlock(p, blockOf(mesh, p, place));
    blocks->GetMetaData(p)->Set(vtkCompositeDataSet::NAME(), names[p].c_str());
  }
  const VtkErrorTrap trap;
  const auto writer = vtkSmartPointer<vtkExodusIIWriter>::New();
  writer->SetInputData(blocks);
  writer->SetFileName(file.c_str());
  writer->SetBlockIdArrayName(kBlockId);
  writer->WriteOutBlockIdArrayOff();
  const bool wrote = writer->Write() != 0;
  if (trap.failed()) throw std::runtime_error(trap.firstError());
  if (!wrote) throw std::runtime_error("the file is incomplete; is the disk full?");
  replaceTitle(file, coordinatesNote(options));
}

}  // namespace sinew
