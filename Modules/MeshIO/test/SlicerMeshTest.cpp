#include "ExampleMesh.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <csignal>
#include <sstream>
#include <sys/resource.h>

namespace sinew {
namespace {

namespace fs = std::filesystem;
using test::readBytes;
using test::TempFolder;
using test::twoTissues;

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> gridOf(const fs::path& file) {
  const vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  if constexpr (std::is_same_v<Reader, vtkUnstructuredGridReader>) reader->ReadAllFieldsOn();
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> readGrid(const fs::path& file) {
  return file.extension() == ".vtu" ? gridOf<vtkXMLUnstructuredGridReader>(file)
                                    : gridOf<vtkUnstructuredGridReader>(file);
}

/// The text that 3D Slicer takes for the space; empty when there is none.
std::string spaceOf(const fs::path& file) {
  const auto grid = readGrid(file);
  auto* space = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("SPACE"));
  return space != nullptr && space->GetNumberOfValues() == 1 ? space->GetValue(0) : "";
}

/// The array that vtkMRMLModelNode::ShowDefaultScalarData shows when a mesh is loaded: the first of three or
/// four unsigned bytes, else the active scalars.
std::string shownAtFirst(vtkUnstructuredGrid* grid) {
  vtkCellData* cells = grid->GetCellData();
  for (int a = 0; a < cells->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = cells->GetArray(a);
    const int parts = array->GetNumberOfComponents();
    if (array->GetDataType() == VTK_UNSIGNED_CHAR && (parts == 3 || parts == 4)) return array->GetName();
  }
  return cells->GetScalars() != nullptr ? cells->GetScalars()->GetName() : "";
}

class SlicerMeshes : public ::testing::TestWithParam<const char*> {
 protected:
  fs::path write(const char* name, const WriteMeshOptions& options = {}) const {
    const fs::path file = folder_ / (std::string(name) + GetParam());
    writeMesh(twoTissues(), file, options);
    return file;
  }

 private:
  TempFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, SlicerMeshes, ::testing::Values(".vtu", ".vtk"),
                         [](const auto& info) { return std::string(info.param + 1); });

TEST_P(SlicerMeshes, M3_LabelsAreActiveAndRgbHasTheTissueColours) {
  const auto grid = readGrid(write("mesh"));
  vtkCellData* cells = grid->GetCellData();
  ASSERT_NE(cells->GetScalars(), nullptr);
  EXPECT_STREQ(cells->GetScalars()->GetName(), "labels");
  EXPECT_EQ(cells->GetScalars()->GetDataType(), VTK_INT);
  EXPECT_EQ(cells->GetScalars()->GetNumberOfComponents(), 1);
  EXPECT_EQ(shownAtFirst(grid), "RGB");
  vtkDataArray* colors = cells->GetArray("RGB");
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    const bool bone = cells->GetScalars()->GetComponent(cell, 0) == -7;
    const std::array<double, 3> wanted = bone ? std::array{255., 128., 0.} : std::array{51., 102., 153.};
    for (int part = 0; part < 3; ++part) ASSERT_EQ(colors->GetComponent(cell, part), wanted[part]);
  }
  EXPECT_EQ(cells->GetArray("material"), nullptr);
  EXPECT_EQ(cells->GetArray("quality")->GetComponent(3, 0), 1.5);
}

TEST_P(SlicerMeshes, M3_MaterialRepeatsTheLabels) {
  const auto grid = readGrid(write("mesh", {.material = true}));
  vtkDataArray* material = grid->GetCellData()->GetArray("material");
  ASSERT_NE(material, nullptr);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    ASSERT_EQ(material->GetComponent(cell, 0), grid->GetCellData()->GetScalars()->GetComponent(cell, 0));
}

TEST_P(SlicerMeshes, M1_RasTurnsXAndY) {
  const auto lps = readGrid(write("lps")), ras = readGrid(write("ras", {.space = Space::Ras}));
  const TissueMesh mesh = twoTissues();
  for (vtkIdType n = 0; n < lps->GetNumberOfPoints(); ++n) {
    const Eigen::Vector3d there(lps->GetPoint(n)), here(ras->GetPoint(n));
    ASSERT_EQ(there, mesh.mesh.nodes[n]);
    ASSERT_EQ(here, Eigen::Vector3d(-there.x(), -there.y(), there.z()));
  }
}

/// Tissues are meshed apart and share no nodes: what M5 says of interfaces does not arise.
TEST_P(SlicerMeshes, M5_TetsStayPositiveAfterTheTurn) {
  const auto ras = readGrid(write("ras", {.space = Space::Ras}));
  const TissueMesh mesh = twoTissues();
  TetMesh turned;
  for (vtkIdType n = 0; n < ras->GetNumberOfPoints(); ++n) turned.nodes.emplace_back(ras->GetPoint(n));
  ASSERT_EQ(ras->GetNumberOfCells(), std::ssize(mesh.mesh.tets));
  for (vtkIdType t = 0; t < ras->GetNumberOfCells(); ++t) {
    const vtkIdType* nodes = nullptr;
    vtkIdType size = 0;
    ras->GetCells()->GetCellAtId(t, size, nodes);
    for (int k = 0; k < 4; ++k) ASSERT_EQ(nodes[k], mesh.mesh.tets[t][k]);
    ASSERT_GT(test::sixVolumes(turned, mesh.mesh.tets[t]), 0);
  }
}

TEST_P(SlicerMeshes, OurReaderTurnsMarkedRasBack) {
  const TissueMesh read = readMesh(write("ras", {.space = Space::Ras}));
  EXPECT_EQ(read.mesh.nodes, twoTissues().mesh.nodes);
  EXPECT_EQ(read.mesh.tets, twoTissues().mesh.tets);
  EXPECT_EQ(read.mesh.labels, twoTissues().mesh.labels);
}

TEST_P(SlicerMeshes, ColoursSurviveToWithinAByte) {
  const TissueMesh read = readMesh(write("mesh"));
  const TissueMesh mesh = twoTissues();
  ASSERT_EQ(read.regions.size(), 2u);
  for (int r = 0; r < 2; ++r) {
    EXPECT_EQ(read.regions[r].label, mesh.regions[r].label);
    for (int part = 0; part < 3; ++part)
      EXPECT_NEAR(read.regions[r].color[part], mesh.regions[r].color[part], 0.5 / 255);
  }
}

TEST_P(SlicerMeshes, UnitsScaleTheCoordinates) {
  const auto grid = readGrid(write("metres", {.perMm = 0.001}));
  EXPECT_EQ(Eigen::Vector3d(grid->GetPoint(5)), 0.001 * twoTissues().mesh.nodes[5]);
}

TEST_P(SlicerMeshes, AFullDiskIsNoticedToTheLastByte) {
  const fs::path file = write("mesh");
  const std::string whole = readBytes(file);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{.rlim_cur = whole.size() - 1, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  EXPECT_THROW(write("mesh"), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(readBytes(file), whole);
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST(SlicerVtu, M1_TheSpaceIsOneTextInTheFieldData) {
  const TempFolder folder;
  writeMesh(twoTissues(), folder / "lps.vtu");
  EXPECT_EQ(spaceOf(folder / "lps.vtu"), "LPS");
  writeMesh(twoTissues(), folder / "ras.vtu", {.space = Space::Ras});
  EXPECT_EQ(spaceOf(folder / "ras.vtu"), "RAS");
  writeMesh(twoTissues(), folder / "metres.vtu", {.perMm = 0.001});
  EXPECT_EQ(spaceOf(folder / "metres.vtu"), "") << "Slicer would take metres for millimetres";
}

TEST(SlicerVtu, M1_WithoutTagThereIsNoFieldData) {
  const TempFolder folder;
  writeMesh(twoTissues(), folder / "a.vtu", {.spaceTag = false});
  EXPECT_EQ(readBytes(folder / "a.vtu").find("FieldData"), std::string::npos);
  EXPECT_EQ(readGrid(folder / "a.vtu")->GetFieldData()->GetNumberOfArrays(), 0);
}

TEST(SlicerVtu, NamesSurviveWhateverTheirCharacters) {
  const TempFolder folder;
  TissueMesh mesh = twoTissues();
  mesh.regions[1].name = "";
  writeMesh(mesh, folder / "a.vtu");
  EXPECT_EQ(readMesh(folder / "a.vtu").regions[0].name, "bone \"left\" <a&b>");
  EXPECT_EQ(readMesh(folder / "a.vtu").regions[1].name, "");
  mesh.regions[1].name = std::string(200, 'x') + "ü/\n";
  writeMesh(mesh, folder / "a.vtu");
  EXPECT_EQ(readMesh(folder / "a.vtu").regions[1].name, mesh.regions[1].name);
}

TEST(SlicerVtu, LabelsWithoutARegionAreNamedByTheirValue) {
  const TempFolder folder;
  TissueMesh mesh = twoTissues();
  mesh.regions.pop_back();
  writeMesh(mesh, folder / "a.vtu");
  EXPECT_EQ(readMesh(folder / "a.vtu").regions[1].name, "Segment_300");
}

TEST(SlicerVtk, M2_TheTitleHasTheSpaceAndTheVersionIsOld) {
  const TempFolder folder;
  const auto firstLines = [&](const WriteMeshOptions& options) {
    writeMesh(twoTissues(), folder / "a.vtk", options);
    std::istringstream bytes(readBytes(folder / "a.vtk"));
    std::string version, title;
    std::getline(bytes, version);
    std::getline(bytes, title);
    return version + "|" + title;
  };
  EXPECT_EQ(firstLines({}), "# vtk DataFile Version 4.2|Sinew SPACE=LPS");
  EXPECT_EQ(firstLines({.space = Space::Ras}), "# vtk DataFile Version 4.2|Sinew SPACE=RAS");
  EXPECT_EQ(firstLines({.spaceTag = false}), "# vtk DataFile Version 4.2|Sinew");
  EXPECT_EQ(readBytes(folder / "a.vtk").find("OFFSETS"), std::string::npos) << "cells as before version 5";
}

}  // namespace
}  // namespace sinew
