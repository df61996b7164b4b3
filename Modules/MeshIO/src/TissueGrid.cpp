#include "TissueGrid.h"

#include "CheckedCells.h"
#include "FieldMarks.h"
#include "MeshFormatTable.h"
#include "Regions.h"
#include "VtkArrays.h"
#include "VtkReading.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <optional>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr const char *kLabels = "labels", *kColors = "RGB", *kMaterial = "material";

// ---- to VTK ----

vtkSmartPointer<vtkDoubleArray> coordinates(const std::vector<Eigen::Vector3d>& nodes,
                                            const WriteMeshOptions& options) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const auto* data = reinterpret_cast<const double*>(nodes.data());
  if (options.space == Space::Lps && options.perMm == 1)
    return wrapArray<vtkDoubleArray>("Points", data, 3 * nodes.size(), 3);
  const auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("Points");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n)
    array->SetTypedTuple(static_cast<vtkIdType>(n), inFile(nodes[n], options).data());
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> colorsOf(const TissueMesh& mesh) {
  const auto colors = regionColors(mesh.regions);
  const auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName(kColors);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(std::ssize(mesh.mesh.labels));
  for (std::size_t t = 0; t < mesh.mesh.labels.size(); ++t)
    array->SetTypedTuple(static_cast<vtkIdType>(t), colors.at(mesh.mesh.labels[t]).data());
  return array;
}

void addArrays(const std::vector<MeshArray>& arrays, Space space, vtkDataSetAttributes* attributes) {
  for (const MeshArray& array : arrays) {
    const auto wrapped = [&](const std::vector<float>& values) {
      return wrapArray<vtkFloatArray>(array.name.c_str(), values.data(), values.size(), array.components);
    };
    if (space == Space::Lps) {
      attributes->AddArray(wrapped(array.values));
    } else {
      const auto copy = vtkSmartPointer<vtkFloatArray>::New();
      copy->DeepCopy(wrapped(turned(array, space)));
      attributes->AddArray(copy);
    }
  }
}

// ---- from VTK ----

/// A cell array of so many components; nullptr when there is none.
vtkDataArray* cellArray(vtkUnstructuredGrid* grid, const char* name, int components) {
  vtkDataArray* array = grid->GetCellData()->GetArray(name);
  return array != nullptr && array->GetNumberOfComponents() == components ? array : nullptr;
}

void takeTets(vtkUnstructuredGrid* grid, const fs::path& file, TetMesh& mesh, FirstCells& firstCells) {
  vtkDataArray* labels = cellArray(grid, kLabels, 1);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (grid->GetCellType(cell) != VTK_TETRA) continue;
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    grid->GetCells()->GetCellAtId(cell, size, points);
    mesh.tets.push_back(checkedTet(points, size, cell, mesh.nodes.size(), file));
    mesh.labels.push_back(labels == nullptr ? 1 : checkedLabel(labels->GetComponent(cell, 0), cell, file));
    firstCells.note(mesh.labels.back(), cell);
  }
}

/// Three bytes a cell; nullptr when there are none.
vtkDataArray* colorArray(vtkUnstructuredGrid* grid) {
  vtkDataArray* colors = cellArray(grid, kColors, 3);
  return colors != nullptr && colors->GetDataType() == VTK_UNSIGNED_CHAR ? colors : nullptr;
}

/// The cell arrays of floating point numbers, of tets alone.
std::vector<MeshArray> cellArraysOf(vtkUnstructuredGrid* grid, Space space) {
  std::vector<MeshArray> arrays;
  for (int a = 0; a < grid->GetCellData()->GetNumberOfArrays(); ++a) {
    vtkDataArray* data = grid->GetCellData()->GetArray(a);
    if (data == nullptr || data->GetName() == nullptr) continue;
    if (data->GetDataType() != VTK_FLOAT && data->GetDataType() != VTK_DOUBLE) continue;
    MeshArray array{data->GetName(), {}, data->GetNumberOfComponents()};
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
      if (grid->GetCellType(cell) == VTK_TETRA)
        for (int c = 0; c < array.components; ++c)
          array.values.push_back(static_cast<float>(data->GetComponent(cell, c)));
    array.values = turned(array, space);
    arrays.push_back(std::move(array));
  }
  return arrays;
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> tissueGrid(const TissueMesh& mesh, const WriteMeshOptions& options) {
  static_assert(sizeof(Tet) == 4 * sizeof(std::int32_t));
  const TetMesh& tets = mesh.mesh;
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates(tets.nodes, options));
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  const auto* indices = reinterpret_cast<const std::int32_t*>(tets.tets.data());
  cells->SetData(4, wrapArray<vtkTypeInt32Array>("connectivity", indices, 4 * tets.tets.size(), 1));

  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(VTK_TETRA, cells);
  const auto labels = [&](const char* name) {
    return wrapArray<vtkTypeInt32Array>(name, tets.labels.data(), tets.labels.size(), 1);
  };
  grid->GetCellData()->SetScalars(labels(kLabels));
  grid->GetCellData()->AddArray(colorsOf(mesh));
  if (options.material) grid->GetCellData()->AddArray(labels(kMaterial));
  addArrays(mesh.arrays.cells, options.space, grid->GetCellData());
  addArrays(mesh.arrays.points, options.space, grid->GetPointData());
  return grid;
}

TissueMesh tissueMeshOf(vtkUnstructuredGrid* grid, bool ras, const fs::path& file,
                        const ReadMeshOptions& options) {
  TissueMesh mesh;
  mesh.mesh.nodes = nodesOf(grid, file);
  if (ras)
    for (Eigen::Vector3d& node : mesh.mesh.nodes) node = inFile(node, {.space = Space::Ras});
  FirstCells firstCells;
  takeTets(grid, file, mesh.mesh, firstCells);
  vtkDataArray* colors = colorArray(grid);
  const auto colorOf = [&](vtkIdType cell) -> std::optional<std::array<double, 3>> {
    if (colors == nullptr) return std::nullopt;
    const double* bytes = colors->GetTuple3(cell);
    return std::array{bytes[0] / 255, bytes[1] / 255, bytes[2] / 255};
  };
  if (options.cellArrays) mesh.arrays.cells = cellArraysOf(grid, ras ? Space::Ras : Space::Lps);
  mesh.regions = firstCells.regions(markedRegions(grid->GetFieldData()), colorOf);
  return mesh;
}

}  // namespace sinew
