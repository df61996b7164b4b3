#include "ExampleMesh.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/SlicerScene.h"
#include "sinew/MeshIO/TriangleFile.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/CommaLocale.h"

#include <gtest/gtest.h>

/// What is written and read depends on nobody's language.
namespace sinew {
namespace {

namespace fs = std::filesystem;

/// Large enough for a dot between thousands.
TissueMesh largeMesh() {
  TissueMesh mesh = test::twoTissues();
  mesh.mesh = test::bccBlock({8, 8, 8});
  mesh.mesh.labels.assign(mesh.mesh.tets.size(), 12345);
  mesh.regions = {{12345, "bone", {0.1, 0.2, 0.3}}};
  mesh.arrays = {};
  for (Eigen::Vector3d& x : mesh.mesh.nodes) x = x * 1234.5678 + Eigen::Vector3d(0.1, -98765.4321, 1e-7);
  return mesh;
}

std::vector<std::string> names() {
  std::vector<std::string> names{"scene.mrml"};
  for (const MeshFormat& format : meshFormats()) names.push_back(std::string("a").append(format.extension));
  return names;
}

void writeAll(const fs::path& folder) {
  const TissueMesh mesh = largeMesh();
  for (const std::string& name : names())
    if (name != "scene.mrml") writeMesh(mesh, folder / name);
  writeSlicerScene({{{"a.vtu", "bone", {0.25, 0.5, 0.75}, 0.5, std::nullopt}}, std::nullopt},
                   folder / "scene.mrml");
}

TEST(Locale, SameBytesWhereADecimalPointIsAComma) {
  const test::TempFolder english, german;
  writeAll(english.path());
  {
    const test::CommaLocale comma;
    writeAll(german.path());
  }
  for (const std::string& name : names())
    EXPECT_TRUE(test::readBytes(german / name) == test::readBytes(english / name)) << name;
}

TEST(Locale, SameMeshesWhereADecimalPointIsAComma) {
  const test::TempFolder folder;
  writeAll(folder.path());
  for (const MeshFormat& format : meshFormats()) {
    const fs::path file = folder / std::string("a").append(format.extension);
    if (format.readable) {
      const TissueMesh read = readMesh(file);
      const test::CommaLocale comma;
      EXPECT_EQ(readMesh(file).mesh.nodes, read.mesh.nodes) << file;
    } else if (format.content == MeshContent::Surface) {
      const TriangleMesh read = readTriangleMesh(file);
      const test::CommaLocale comma;
      EXPECT_EQ(readTriangleMesh(file).nodes, read.nodes) << file;
    }
  }
}

}  // namespace
}  // namespace sinew
