#include "sinew/MeshIO/VtuFile.h"

#include "GuardedXmlReader.h"
#include "VtkReading.h"
#include "sinew/Mesher/MeshConditions.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLabels = "labels";

/// Fast: on tet meshes level 1 is within a few percent of the default level's size.
constexpr int kCompressionLevel = 1;

/// FEBio Studio reads an array only when it is one block; the bound keeps the compressor's buffer small for
/// huge meshes.
constexpr std::size_t kBlockBytes = std::size_t{1} << 26;

// ---- writing ----

/// A VTK array on memory that it neither owns nor changes.
template <class Array, class T>
vtkSmartPointer<Array> wrap(const T* data, std::size_t values, int components) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  constexpr int keepMemory = 1;
  array->SetArray(const_cast<T*>(data), static_cast<vtkIdType>(values), keepMemory);
  return array;
}

void addArrays(const std::vector<MeshArray>& arrays, vtkDataSetAttributes* attributes) {
  for (const MeshArray& array : arrays) {
    const auto wrapped = wrap<vtkFloatArray>(array.values.data(), array.values.size(), 1);
    wrapped->SetName(array.name.c_str());
    attributes->AddArray(wrapped);
  }
}

vtkSmartPointer<vtkUnstructuredGrid> gridOn(const TetMesh& mesh, const MeshArrays& further) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double) && sizeof(Tet) == 4 * sizeof(std::int32_t));
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto* coordinates = reinterpret_cast<const double*>(mesh.nodes.data());
  points->SetData(wrap<vtkDoubleArray>(coordinates, 3 * mesh.nodes.size(), 3));

  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  const auto* indices = reinterpret_cast<const std::int32_t*>(mesh.tets.data());
  cells->SetData(4, wrap<vtkTypeInt32Array>(indices, 4 * mesh.tets.size(), 1));

  const auto labels = wrap<vtkTypeInt32Array>(mesh.labels.data(), mesh.labels.size(), 1);
  labels->SetName(kLabels);

  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(VTK_TETRA, cells);
  grid->GetCellData()->SetScalars(labels);
  addArrays(further.cells, grid->GetCellData());
  addArrays(further.points, grid->GetPointData());
  return grid;
}

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

/// VTK's writer checks its stream between arrays, not when it closes the file.
bool endsLikeVtu(const fs::path& file) {
  const std::string end = "</VTKFile>\n";
  std::ifstream stream(file, std::ios::binary);
  std::string found(end.size(), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  stream.read(found.data(), static_cast<std::streamsize>(found.size()));
  return stream && found == end;
}

/// @return what went wrong; empty when the file is complete
std::string writeGrid(vtkUnstructuredGrid* grid, const fs::path& file) {
  const VtkErrorTrap trap;
  const auto writer = vtkSmartPointer<VtuWriter>::New();
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  writer->SetDataModeToBinary();  // inline base64: FEBio Studio and older meshio read no appended data
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(kCompressionLevel);
  writer->SetBlockSize(kBlockBytes);
  const bool wrote = writer->Write() != 0;
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
    return vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode());
  if (trap.failed()) return trap.firstError();
  return wrote && endsLikeVtu(file) ? "" : "the file is incomplete; is the disk full?";
}

void checkSize(const std::string& name, std::size_t values, std::size_t wanted, const char* of) {
  if (values != wanted)
    throw std::invalid_argument("writeVtu: " + std::to_string(values) + " " + name + " for " +
                                std::to_string(wanted) + " " + of);
}

// ---- reading ----

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> readWith(const fs::path& file) {
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(file.c_str());
  if constexpr (std::is_same_v<Reader, vtkUnstructuredGridReader>) {
    reader->ReadAllScalarsOn();
    reader->ReadAllFieldsOn();
  }
  update(reader, file, "an unstructured grid");
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> readGrid(const fs::path& file) {
  requireReadable(file);
  const std::string extension = file.extension().string();
  if (extension == ".vtu") return readWith<GuardedXmlReader<vtkXMLUnstructuredGridReader>>(file);
  if (extension == ".vtk") return readWith<vtkUnstructuredGridReader>(file);
  fail(file, "unknown kind of mesh; .vtu and .vtk can be read");
}

/// The label of one cell: whole, and in the range of the original values.
std::int32_t labelOf(vtkDataArray* labels, vtkIdType cell, const fs::path& file) {
  if (labels == nullptr) return 1;
  const double value = labels->GetComponent(cell, 0);
  using Limits = std::numeric_limits<std::int32_t>;
  if (!(value == std::floor(value) && value >= Limits::min() && value <= Limits::max()))
    fail(file, "cell " + std::to_string(cell) + " has the label " + std::to_string(value) +
                   ", which is not a 32-bit whole number");
  return static_cast<std::int32_t>(value);
}

Tet tetOf(const vtkIdType* points, vtkIdType cell, std::size_t nodeCount, const fs::path& file) {
  Tet tet{};
  for (int k = 0; k < 4; ++k) {
    if (points[k] < 0 || static_cast<std::size_t>(points[k]) >= nodeCount)
      fail(file, "cell " + std::to_string(cell) + " names a node that is not there");
    tet[k] = static_cast<std::int32_t>(points[k]);
  }
  return tet;
}

void takeTets(vtkUnstructuredGrid* grid, const fs::path& file, TetMesh& mesh) {
  vtkDataArray* labels = grid->GetCellData()->GetArray(kLabels);
  if (labels != nullptr && labels->GetNumberOfComponents() != 1) labels = nullptr;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (grid->GetCellType(cell) != VTK_TETRA) continue;
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    grid->GetCells()->GetCellAtId(cell, size, points);
    if (size != 4) fail(file, "cell " + std::to_string(cell) + " is a tet without four nodes");
    mesh.tets.push_back(tetOf(points, cell, mesh.nodes.size(), file));
    mesh.labels.push_back(labelOf(labels, cell, file));
  }
}

std::vector<NodeKind> kindsOf(const TetMesh& mesh) {
  std::vector<NodeKind> kinds(mesh.nodes.size(), NodeKind::Interior);
  for (const Triangle& triangle : meshBoundary(mesh).triangles)
    for (const std::int32_t node : triangle) kinds[static_cast<std::size_t>(node)] = NodeKind::Boundary;
  return kinds;
}

}  // namespace

void writeVtu(const TetMesh& mesh, const fs::path& file, const MeshArrays& further) {
  checkSize(kLabels, mesh.labels.size(), mesh.tets.size(), "tets");
  for (const MeshArray& array : further.cells)
    checkSize(array.name, array.values.size(), mesh.tets.size(), "tets");
  for (const MeshArray& array : further.points)
    checkSize(array.name, array.values.size(), mesh.nodes.size(), "nodes");
  const bool replaceable = !fs::exists(file) || fs::is_regular_file(file);
  const fs::path partial = replaceable ? fs::path(file).concat(".partial") : file;
  std::string problem = writeGrid(gridOn(mesh, further), partial);
  std::error_code error;
  if (problem.empty() && replaceable) fs::rename(partial, file, error);
  if (error) problem = error.message();
  if (problem.empty()) return;
  if (replaceable) fs::remove(partial, error);
  fail(file, "cannot be written (" + problem + ")");
}

TetMesh readTetMesh(const fs::path& file) try {
  TetMesh mesh;
  const auto grid = readGrid(file);
  mesh.nodes = nodesOf(grid, file);
  takeTets(grid, file, mesh);
  if (mesh.tets.empty()) fail(file, "has no tetrahedra");
  mesh.kinds = kindsOf(mesh);
  return mesh;
} catch (const std::bad_alloc&) {
  fail(file, "needs more memory than there is");
}

}  // namespace sinew
