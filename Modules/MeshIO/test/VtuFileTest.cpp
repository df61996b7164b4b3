#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/LatticeMesh.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <csignal>
#include <limits>
#include <sys/resource.h>
#include <thread>

/// For the leak sanitizer: VTK 9.1 loses a compression header in every write that runs into a full disk.
extern "C" const char* __lsan_default_suppressions() { return "leak:libvtkIOXML"; }

namespace sinew {
namespace {

namespace fs = std::filesystem;
using test::messageOf;
using test::readBytes;
using test::TempFolder;
using test::writeBytes;

/// A ball of lattice tets with coordinates and labels that only exact storage keeps.
TetMesh exampleMesh() {
  TetMesh mesh = test::bccBlock({5, 5, 5});
  for (Eigen::Vector3d& x : mesh.nodes) x = x * (1.0 / 3) + Eigen::Vector3d(-123.456, 1e-17, 1e6);
  for (std::size_t t = 0; t < mesh.labels.size(); ++t) mesh.labels[t] = int(t) * 7919;
  mesh.labels[0] = std::numeric_limits<std::int32_t>::max();
  mesh.labels[1] = std::numeric_limits<std::int32_t>::min();
  return mesh;
}

void writeTets(const TetMesh& mesh, const fs::path& file, const MeshArrays& further = {}) {
  writeMesh({mesh, {}, further}, file);
}
TetMesh readTets(const fs::path& file) { return readMesh(file).mesh; }

std::string messageOfReading(const fs::path& file) {
  return messageOf<std::runtime_error>([&] { readTets(file); });
}
std::string messageOfWriting(const fs::path& file) {
  return messageOf<std::runtime_error>([&] { writeTets(exampleMesh(), file); });
}

/// One line that starts with the file; silence on both streams is checked by the caller.
void expectNames(const std::string& message, const fs::path& file) {
  EXPECT_TRUE(message.starts_with(file.string() + ": ")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

/// What a test must not find on the terminal: VTK's own messages.
class VtuFileErrors : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
  }
  void TearDown() override {
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  }
  TempFolder folder_;
};

TEST(VtuFile, KeepsEveryBit) {
  const TempFolder folder;
  const TetMesh mesh = exampleMesh();
  writeTets(mesh, folder / "a.vtu");
  const TetMesh read = readTets(folder / "a.vtu");
  EXPECT_EQ(read.nodes, mesh.nodes);
  EXPECT_EQ(read.tets, mesh.tets);
  EXPECT_EQ(read.labels, mesh.labels);
}

TEST(VtuFile, KindsComeFromTheBoundary) {
  const TempFolder folder;
  const TetMesh block = test::bccBlock({3, 3, 3});
  writeTets(block, folder / "a.vtu");
  const TetMesh read = readTets(folder / "a.vtu");
  ASSERT_EQ(read.kinds.size(), read.nodes.size());
  // Of a block of n^3 cubes the outer layer of centres is the boundary, and the lattice corners that stick
  // out of it.
  for (std::size_t i = 0; i < read.nodes.size(); ++i) {
    const Eigen::Vector3d fromCentre = read.nodes[i] - Eigen::Vector3d::Constant(1.5);
    EXPECT_EQ(read.kinds[i] == NodeKind::Interior, fromCentre.lpNorm<Eigen::Infinity>() < 0.9)
        << read.nodes[i];
  }
}

TEST(VtuFile, SameBytesEveryTimeAndFromEveryThread) {
  const TempFolder folder;
  const TetMesh mesh = exampleMesh();
  writeTets(mesh, folder / "first.vtu");
  {
    const auto writeAgain = [&](const char* name) { writeTets(mesh, folder / name); };
    std::jthread a(writeAgain, "second.vtu"), b(writeAgain, "third.vtu");
  }
  EXPECT_EQ(readBytes(folder / "first.vtu"), readBytes(folder / "second.vtu"));
  EXPECT_EQ(readBytes(folder / "first.vtu"), readBytes(folder / "third.vtu"));
}

TEST(VtuFile, HasTheFormThatOtherReadersNeed) {
  const TempFolder folder;
  writeTets(exampleMesh(), folder / "a.vtu");
  const std::string bytes = readBytes(folder / "a.vtu");
  EXPECT_EQ(bytes.find("appended"), std::string::npos);  // FEBio Studio does not decode cell data there
  EXPECT_NE(bytes.find("vtkZLibDataCompressor"), std::string::npos);
  EXPECT_NE(bytes.find("<CellData Scalars=\"labels\">"), std::string::npos);
  EXPECT_NE(bytes.find("type=\"Int32\" Name=\"labels\""), std::string::npos);
  EXPECT_NE(bytes.find("type=\"Float64\" Name=\"Points\""), std::string::npos);
}

TEST(VtuFile, LabelsAreTheActiveScalars) {
  const TempFolder folder;
  writeTets(exampleMesh(), folder / "a.vtu");
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "a.vtu").c_str());
  reader->Update();
  vtkDataArray* scalars = reader->GetOutput()->GetCellData()->GetScalars();
  ASSERT_NE(scalars, nullptr);
  EXPECT_STREQ(scalars->GetName(), "labels");
  EXPECT_EQ(scalars->GetDataType(), VTK_INT);
}

TEST(VtuFile, FurtherArraysStandBesideTheLabels) {
  const TempFolder folder;
  const TetMesh mesh = exampleMesh();
  MeshArrays further;
  further.cells = {{"quality", std::vector<float>(mesh.tets.size(), 1.5F)},
                   {"other", std::vector<float>(mesh.tets.size(), -2)}};
  further.points = {{"phi", {}}};
  for (const Eigen::Vector3d& x : mesh.nodes) further.points[0].values.push_back(static_cast<float>(x.x()));
  writeTets(mesh, folder / "a.vtu", further);
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "a.vtu").c_str());
  reader->Update();
  vtkCellData* cells = reader->GetOutput()->GetCellData();
  EXPECT_STREQ(cells->GetScalars()->GetName(), "labels");
  ASSERT_EQ(cells->GetNumberOfArrays(), 4) << "and RGB";
  EXPECT_EQ(cells->GetArray("quality")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(cells->GetArray("quality")->GetComponent(7, 0), 1.5);
  EXPECT_EQ(cells->GetArray("other")->GetComponent(7, 0), -2);
  vtkDataArray* phi = reader->GetOutput()->GetPointData()->GetArray("phi");
  ASSERT_NE(phi, nullptr);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    ASSERT_EQ(phi->GetComponent(vtkIdType(n), 0), static_cast<float>(mesh.nodes[n].x()));
  EXPECT_EQ(readTets(folder / "a.vtu").tets, mesh.tets);
}

TEST(VtuFile, LeavesNothingButTheFile) {
  const TempFolder folder;
  writeBytes(folder / "a.vtu", "an older file");
  writeTets(exampleMesh(), folder / "a.vtu");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
  EXPECT_EQ(readTets(folder / "a.vtu").tets, exampleMesh().tets);
}

TEST(ReadMesh, PassesOtherCellsOverAndReadsLegacyFiles) {
  const TempFolder folder;
  writeBytes(folder / "a.vtk",
             "# vtk DataFile Version 3.0\nmixed\nASCII\nDATASET UNSTRUCTURED_GRID\n"
             "POINTS 5 double\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n"
             "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 4 1 3 2\nCELL_TYPES 3\n5\n10\n10\n"
             "CELL_DATA 3\nSCALARS other float 1\nLOOKUP_TABLE default\n9 9 9\n"
             "SCALARS labels int 1\nLOOKUP_TABLE default\n5 6 7\n");
  const TetMesh mesh = readTets(folder / "a.vtk");
  EXPECT_EQ(mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {4, 1, 3, 2}}));
  EXPECT_EQ(mesh.labels, (std::vector<std::int32_t>{6, 7}));
}

TEST(ReadMesh, WithoutLabelsTheyAreOne) {
  const TempFolder folder;
  writeBytes(folder / "a.vtk",
             "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\n"
             "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
  EXPECT_EQ(readTets(folder / "a.vtk").labels, std::vector<std::int32_t>{1});
}

/// VTK crashed on this one: it looked for the name of the array in point data that are not there.
TEST_F(VtuFileErrors, CellArrayThatIsNoNumbers) {
  writeBytes(folder_ / "a.vtu",
             "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid>"
             "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>"
             "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 "
             "1</DataArray>"
             "</Points><Cells>"
             "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
             "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
             "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells><CellData>"
             "<DataArray type=\"Int32\" Name=\"labels\" format=\"ascii\">seven</DataArray>"
             "</CellData></Piece></UnstructuredGrid></VTKFile>\n");
  expectNames(messageOfReading(folder_ / "a.vtu"), folder_ / "a.vtu");
}

TEST_F(VtuFileErrors, MissingFile) {
  const std::string message = messageOfReading(folder_ / "none.vtu");
  expectNames(message, folder_ / "none.vtu");
  EXPECT_NE(message.find("no such file"), std::string::npos);
}

TEST_F(VtuFileErrors, UnknownKind) {
  writeBytes(folder_ / "a.stl", "solid");
  EXPECT_NE(messageOfReading(folder_ / "a.stl").find(".vtu, .vtk and .msh"), std::string::npos);
}

TEST_F(VtuFileErrors, NotAMesh) {
  for (const char* name : {"a.vtu", "a.vtk"})
    for (const char* bytes :
         {"", "garbage", "<VTKFile>", "<VTKFile type=\"PolyData\" version=\"1.0\"></VTKFile>",
          "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"}) {
      writeBytes(folder_ / name, bytes);
      expectNames(messageOfReading(folder_ / name), folder_ / name);
    }
}

TEST_F(VtuFileErrors, EveryTruncationIsNoticed) {
  writeTets(exampleMesh(), folder_ / "whole.vtu");
  const std::string whole = readBytes(folder_ / "whole.vtu");
  const std::size_t body = whole.rfind("</VTKFile>");
  for (std::size_t length = 0; length < body; length += 97) {
    writeBytes(folder_ / "cut.vtu", whole.substr(0, length));
    expectNames(messageOfReading(folder_ / "cut.vtu"), folder_ / "cut.vtu");
  }
}

TEST_F(VtuFileErrors, DamagedData) {
  writeTets(exampleMesh(), folder_ / "a.vtu");
  std::string bytes = readBytes(folder_ / "a.vtu");
  const std::size_t connectivity = bytes.find('\n', bytes.find("Name=\"connectivity\""));
  std::fill_n(bytes.begin() + std::ptrdiff_t(connectivity) + 60, 40, 'A');
  writeBytes(folder_ / "a.vtu", bytes);
  expectNames(messageOfReading(folder_ / "a.vtu"), folder_ / "a.vtu");
}

TEST_F(VtuFileErrors, BadCells) {
  const auto legacy = [](const std::string& points, const std::string& cell, const std::string& label) {
    return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n" + points +
           "\nCELLS 1 5\n" + cell + "\nCELL_TYPES 1\n10\nCELL_DATA 1\nSCALARS labels double 1\n" +
           "LOOKUP_TABLE default\n" + label + "\n";
  };
  const std::string points = "0 0 0 1 0 0 0 1 0 0 0 1", cell = "4 0 1 2 3";
  const fs::path file = folder_ / "a.vtk";
  const auto messageFor = [&](const std::string& bytes) {
    writeBytes(file, bytes);
    return messageOfReading(file);
  };
  EXPECT_EQ(messageFor(legacy(points, cell, "3")), "");
  expectNames(messageFor(legacy(points, "4 0 1 2 9", "3")), file);
  expectNames(messageFor(legacy(points, "4 0 1 2 -1", "3")), file);
  expectNames(messageFor(legacy("0 0 0 nan 0 0 0 1 0 0 0 1", cell, "3")), file);
  EXPECT_NE(messageFor(legacy(points, cell, "2.5")).find("2.5"), std::string::npos);
  EXPECT_NE(messageFor(legacy(points, cell, "3e9")).find("32-bit"), std::string::npos);
}

/// VTK counted, divided by zero, or ran out of its stack; the corpus of the fuzzers has more of these.
TEST_F(VtuFileErrors, WhatAHeaderPromisesIsNotBelieved) {
  writeTets(exampleMesh(), folder_ / "a.vtu");
  const std::string whole = readBytes(folder_ / "a.vtu");
  const auto messageWith = [&](const std::string& from, const std::string& to) {
    std::string bytes = whole;
    bytes.replace(bytes.find(from), from.size(), to);
    writeBytes(folder_ / "b.vtu", bytes);
    return messageOfReading(folder_ / "b.vtu");
  };
  const fs::path file = folder_ / "b.vtu";
  for (const char* many : {"1000000000000", "-5", "1e300"}) {
    expectNames(messageWith("NumberOfPoints=\"", "NumberOfPoints=\"" + std::string(many)), file);
    expectNames(messageWith("NumberOfComponents=\"", "NumberOfComponents=\"" + std::string(many)), file);
    expectNames(messageWith("NumberOfTuples=\"", "NumberOfTuples=\"" + std::string(many)), file);
  }
  std::string nested, ends;
  for (int depth = 0; depth < 100'000; ++depth) nested += "<a>", ends += "</a>";
  expectNames(messageWith("<Piece", nested + ends + "<Piece"), file);
}

TEST_F(VtuFileErrors, NoTets) {
  writeTets({}, folder_ / "empty.vtu");
  EXPECT_NE(messageOfReading(folder_ / "empty.vtu").find("no tetrahedra"), std::string::npos);
}

TEST_F(VtuFileErrors, UnwritablePlaces) {
  expectNames(messageOfWriting(folder_ / "none" / "a.vtu"), folder_ / "none" / "a.vtu");
  fs::create_directory(folder_ / "folder.vtu");
  expectNames(messageOfWriting(folder_ / "folder.vtu"), folder_ / "folder.vtu");
  EXPECT_TRUE(fs::is_directory(folder_ / "folder.vtu"));
}

TEST_F(VtuFileErrors, AFullDiskLeavesTheOlderFile) {
  std::signal(SIGXFSZ, SIG_IGN);
  writeBytes(folder_ / "a.vtu", "an older file");
  writeTets(exampleMesh(), folder_ / "whole.vtu");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  // The limit stands in for the disk, down to the bytes that the stream holds back until it closes.
  const auto size = static_cast<rlim_t>(fs::file_size(folder_ / "whole.vtu"));
  for (rlim_t room = (size - 1) % 499; room < size; room += 499) {
    const rlimit full{.rlim_cur = room, .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    const std::string message = messageOfWriting(folder_ / "a.vtu");
    setrlimit(RLIMIT_FSIZE, &before);
    expectNames(message, folder_ / "a.vtu");
    EXPECT_EQ(readBytes(folder_ / "a.vtu"), "an older file");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 2);
  }
}

TEST_F(VtuFileErrors, LabelsThatDoNotFit) {
  TetMesh mesh = exampleMesh();
  mesh.labels.pop_back();
  EXPECT_THROW(writeTets(mesh, folder_ / "a.vtu"), std::invalid_argument);
  const std::string message = messageOf<std::invalid_argument>([&] {
    writeTets(exampleMesh(), folder_ / "a.vtu", {.cells = {}, .points = {{"phi", {1, 2}}}});
  });
  EXPECT_TRUE(message.starts_with("writeMesh: 2 phi for ")) << message;
  EXPECT_FALSE(fs::exists(folder_ / "a.vtu"));
}

}  // namespace
}  // namespace sinew
