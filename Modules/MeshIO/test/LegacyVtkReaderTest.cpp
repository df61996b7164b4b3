#include "ExampleMesh.h"
#include "TissueGrid.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGridWriter.h>

namespace sinew {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

template <class Array>
vtkSmartPointer<Array> filled(const char* name, int components, vtkIdType tuples) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < components * tuples; ++i) array->SetValue(i, i % 2);
  return array;
}

/// Attributes of every kind around the two that are read.
vtkSmartPointer<vtkUnstructuredGrid> richGrid(const TissueMesh& mesh) {
  const auto grid = tissueGrid(mesh, {});
  const vtkIdType cells = grid->GetNumberOfCells(), points = grid->GetNumberOfPoints();
  const vtkNew<vtkStringArray> texts;
  texts->SetName("texts");
  for (const int length : {0, 3, 70, 20'000}) texts->InsertNextValue(std::string(length, 'x') + " \n%");
  grid->GetFieldData()->AddArray(texts);
  for (vtkDataSetAttributes* attributes : {static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
                                           static_cast<vtkDataSetAttributes*>(grid->GetCellData())}) {
    const vtkIdType tuples = attributes == grid->GetPointData() ? points : cells;
    attributes->SetVectors(filled<vtkFloatArray>("v", 3, tuples));
    attributes->SetNormals(filled<vtkFloatArray>("n", 3, tuples));
    attributes->SetTCoords(filled<vtkFloatArray>("t", 2, tuples));
    attributes->SetTensors(filled<vtkFloatArray>("tensor", 9, tuples));
    attributes->SetGlobalIds(filled<vtkIdTypeArray>("ids", 1, tuples));
    attributes->AddArray(filled<vtkBitArray>("bits", 1, tuples));
  }
  return grid;
}

struct Kind {
  int version;
  bool binary;
};
class LegacyVtkReader : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, LegacyVtkReader,
                         ::testing::Values(Kind{42, false}, Kind{42, true}, Kind{51, false}, Kind{51, true}),
                         [](const auto& info) {
                           return (info.param.binary ? "Binary" : "Text") +
                                  std::to_string(info.param.version);
                         });

TEST_P(LegacyVtkReader, ReadsWhatVtkWrites) {
  const TempFolder folder;
  const TissueMesh mesh = test::twoTissues();
  const vtkNew<vtkUnstructuredGridWriter> writer;
  const auto grid = richGrid(mesh);
  writer->SetInputData(grid);
  writer->SetFileName((folder / "a.vtk").c_str());
  writer->SetFileVersion(GetParam().version);
  GetParam().binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
  writer->Write();
  const TissueMesh read = readMesh(folder / "a.vtk");
  EXPECT_EQ(read.mesh.tets, mesh.mesh.tets);
  EXPECT_EQ(read.mesh.labels, mesh.mesh.labels);
  EXPECT_EQ(read.mesh.nodes, mesh.mesh.nodes) << "multiples of 1/4, which eleven digits hold";
  ASSERT_EQ(read.regions.size(), 2u);
  EXPECT_NEAR(read.regions[0].color[1], 0.5, 0.5 / 255);

  EXPECT_TRUE(read.arrays.cells.empty());
  const MeshArrays arrays = readMesh(folder / "a.vtk", {.cellArrays = true}).arrays;
  const auto values = [](const std::vector<MeshArray>& list, const std::string& name) {
    const auto found = std::ranges::find(list, name, &MeshArray::name);
    return found == list.end() ? std::vector<float>() : found->values;
  };
  EXPECT_EQ(values(arrays.cells, "quality"), mesh.arrays.cells[0].values);
  EXPECT_EQ(values(arrays.cells, "fibres"), mesh.arrays.cells[1].values);
}

const std::string kSound = R"(# vtk DataFile Version 3.0
x
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 0 0 1 0 0 0 1 0 0 0 1
CELLS 1 5
4 0 1 2 3
CELL_TYPES 1
10
CELL_DATA 1
SCALARS labels int 1
LOOKUP_TABLE default
3
)";

/// Each change ends in one line that names the file; none may cost the memory that it promises.
TEST(LegacyVtkErrors, HostileCounts) {
  const TempFolder folder;
  const fs::path file = folder / "a.vtk";
  const auto messageWith = [&](const std::string& from, const std::string& to) {
    std::string bytes = kSound;
    bytes.replace(bytes.find(from), from.size(), to);
    test::writeBytes(file, bytes);
    return test::messageOf<std::runtime_error>([&] { readMesh(file); });
  };
  EXPECT_EQ(messageWith("x", "y"), "");
  const std::vector<std::pair<std::string, std::string>> changes{
      {"POINTS 4", "POINTS 1000000000000000000"},
      {"POINTS 4", "POINTS -4"},
      {"POINTS 4", "POINTS 9223372036854775807"},
      {"ASCII", "BINARY"},
      {"ASCII", "TEXT"},
      {"UNSTRUCTURED_GRID", "POLYDATA"},
      {"0 0 0 1", "0 0 0 one"},
      {"0 0 0 1", "0 0 0 inf"},
      {"CELLS 1 5", "CELLS 1000000000000 5000000000000"},
      {"CELLS 1 5", "CELLS 1 3"},
      {"CELLS 1 5", "CELLS 2 5"},
      {"CELLS 1 5", "CELLS"},
      {"4 0 1 2 3", "400000000 0 1 2 3"},
      {"4 0 1 2 3", "-4 0 1 2 3"},
      {"4 0 1 2 3", "3 0 1 2 0"},
      {"4 0 1 2 3", "4 0 1 2 4"},
      {"4 0 1 2 3", "4 0 1 2 2.5"},
      {"4 0 1 2 3", "4 0 1 2 nan"},
      {"CELL_TYPES 1\n10", "CELL_TYPES 2\n10 10"},
      {"CELL_TYPES 1\n10", "CELL_TYPES 0"},
      {"CELL_DATA 1", "CELL_DATA 1000000000"},
      {"labels int 1", "other int 1000000000000000000"},
      {"labels int 1", "labels int -1"},
      {"CELL_DATA 1", "FIELD FieldData 1000000000\na 1000000 1000000 double\n1 2\nCELL_DATA 1"},
      {"CELL_DATA 1", "FIELD f 1\na 4000000000 4000000000 double\n1\nCELL_DATA 1"},
      {"CELL_DATA 1", "NONSENSE 1"},
  };
  for (const auto& [from, to] : changes) {
    const std::string message = messageWith(from, to);
    EXPECT_TRUE(message.starts_with(file.string() + ": ")) << to << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace sinew
