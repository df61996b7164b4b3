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
