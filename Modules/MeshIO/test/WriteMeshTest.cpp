#include "ExampleMesh.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/LatticeMesh.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

using test::messageOf;
using test::TempFolder;

TissueMesh block() { return {test::bccBlock({3, 3, 3}), {{1, "bone", {1, 0.5, 0}}}, {}}; }

TEST(MeshFormats, AreFoundByTheEndOfAName) {
  ASSERT_NE(findMeshFormat("a.b.vtu"), nullptr);
  EXPECT_EQ(findMeshFormat("a.VTU")->extension, ".vtu");
  EXPECT_EQ(findMeshFormat("vtu"), nullptr);
  EXPECT_EQ(findMeshFormat(".vtu"), nullptr);
  EXPECT_EQ(meshFormats().front().extension, ".vtu");
}

TEST(WriteMesh, WhatItWritesReadMeshReads) {
  const TempFolder folder;
  writeMesh(block(), folder / "a.vtu");
  const TissueMesh read = readMesh(folder / "a.vtu");
  EXPECT_EQ(read.mesh.tets, block().mesh.tets);
  EXPECT_EQ(read.mesh.nodes, block().mesh.nodes);
}

TEST(WriteMesh, ArraysComeBackInBothSpaces) {
  const TempFolder folder;
  const TissueMesh mesh = test::twoTissues();
  for (const char* name : {"a.vtu", "a.vtk"})
    for (const Space space : {Space::Lps, Space::Ras}) {
      writeMesh(mesh, folder / name, {.space = space});
      EXPECT_TRUE(readMesh(folder / name).arrays.cells.empty());
      const MeshArrays read = readMesh(folder / name, {.cellArrays = true}).arrays;
      ASSERT_EQ(read.cells.size(), 2u) << name;
      EXPECT_EQ(read.cells[0].values, mesh.arrays.cells[0].values);
      EXPECT_EQ(read.cells[1].name, "fibres");
      EXPECT_EQ(read.cells[1].components, 3);
      EXPECT_EQ(read.cells[1].values, mesh.arrays.cells[1].values) << "vectors turn twice";
    }
}

TEST(ReadMesh, ArraysOfOtherCellsArePassedOver) {
  const TempFolder folder;
  test::writeBytes(folder / "a.vtk",
                   "# vtk DataFile Version 3.0\nx SPACE=RAS\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                   "POINTS 5 double\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n"
                   "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 4 1 3 2\nCELL_TYPES 3\n5\n10\n10\n"
                   "CELL_DATA 3\nVECTORS a%20name double\n1 2 3 4 5 6 7 8 9\n"
                   "SCALARS whole int 1\nLOOKUP_TABLE default\n1 2 3\n");
  const MeshArrays arrays = readMesh(folder / "a.vtk", {.cellArrays = true}).arrays;
  ASSERT_EQ(arrays.cells.size(), 1u);
  EXPECT_EQ(arrays.cells[0].name, "a name");
  EXPECT_EQ(arrays.cells[0].values, (std::vector<float>{-4, -5, 6, -7, -8, 9}));
}

TEST(WriteMesh, AnUnknownFormatIsRefused) {
  const TempFolder folder;
  const std::string message = messageOf<std::runtime_error>([&] { writeMesh(block(), folder / "a.txt"); });
  EXPECT_NE(message.find("a.txt: unknown kind of mesh file; known are .vtu"), std::string::npos) << message;
}

TEST(WriteMesh, ValuesThatDoNotFitAreRefused) {
  const TempFolder folder;
  TissueMesh mesh = block();
  mesh.arrays.points = {{"phi", {1, 2}}};
  const auto write = [&] { writeMesh(mesh, folder / "a.vtu"); };
  EXPECT_TRUE(messageOf<std::invalid_argument>(write).starts_with("writeMesh: 2 phi for "));
}

}  // namespace
}  // namespace sinew
