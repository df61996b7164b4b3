#include "ExampleMesh.h"
#include "sinew/MeshIO/TriangleFile.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <csignal>
#include <map>
#include <set>
#include <sys/resource.h>

namespace sinew {
namespace {

namespace fs = std::filesystem;
using test::readBytes;
using test::TempFolder;
using test::twoTissues;

/// By the divergence theorem; positive when the triangles are outward.
double enclosedVolume(const TriangleMesh& mesh) {
  double sixfold = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sixfold += mesh.nodes[a].cross(mesh.nodes[b]).dot(mesh.nodes[c]);
  return sixfold / 6;
}

double volume(const TetMesh& mesh) {
  double sixfold = 0;
  for (const Tet& tet : mesh.tets) sixfold += test::sixVolumes(mesh, tet);
  return sixfold / 6;
}

/// Every edge is there once in each direction.
bool closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  return std::ranges::all_of(edges, [&](const auto& edge) {
    return edge.second == 1 && edges.contains({edge.first.second, edge.first.first});
  });
}

class Surfaces : public ::testing::TestWithParam<const char*> {
 protected:
  fs::path write(const char* name, const WriteMeshOptions& options = {},
                 const TissueMesh& mesh = twoTissues()) {
    const fs::path file = folder_ / (std::string(name) + GetParam());
    writeMesh(mesh, file, options);
    return file;
  }
  TempFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Formats, Surfaces, ::testing::Values(".stl", ".ply", ".obj", ".vtp"),
                         [](const auto& info) { return std::string(info.param + 1); });

TEST_P(Surfaces, AreClosedOutwardAndEncloseTheTets) {
  for (const Space space : {Space::Lps, Space::Ras}) {
    const TriangleMesh read = readTriangleMesh(write("a", {.space = space}));
    EXPECT_TRUE(closed(read));
    // The coordinates are multiples of 1/4, which float keeps.
    EXPECT_NEAR(enclosedVolume(read), volume(twoTissues().mesh), 1e-12);
  }
}

TEST_P(Surfaces, M1_RasTurnsXAndY) {
  const TriangleMesh lps = readTriangleMesh(write("lps")),
                     ras = readTriangleMesh(write("ras", {.space = Space::Ras}));
  ASSERT_EQ(lps.nodes.size(), ras.nodes.size());
  EXPECT_EQ(lps.triangles, ras.triangles);
  for (std::size_t n = 0; n < lps.nodes.size(); ++n)
    ASSERT_EQ(ras.nodes[n], Eigen::Vector3d(-lps.nodes[n].x(), -lps.nodes[n].y(), lps.nodes[n].z()));
}

TEST_P(Surfaces, SharedFacesBelongToBothTissues) {
  TissueMesh halves{test::bccBlock({4, 4, 4}), {{1, "low"}, {2, "high"}}, {}};
  for (std::size_t t = 0; t < halves.mesh.tets.size(); ++t)
    halves.mesh.labels[t] = halves.mesh.nodes[halves.mesh.tets[t][0]].z() < 2 ? 1 : 2;
  TissueMesh whole = halves;
  whole.mesh.labels.assign(whole.mesh.tets.size(), 1);
  const TriangleMesh apart = readTriangleMesh(write("halves", {}, halves)),
                     one = readTriangleMesh(write("whole", {}, whole));
  EXPECT_GT(apart.triangles.size(), one.triangles.size());
  EXPECT_NEAR(enclosedVolume(apart), volume(whole.mesh), 1e-12);
}

TEST_P(Surfaces, SameBytesEveryTime) { EXPECT_EQ(readBytes(write("a")), readBytes(write("b"))); }

TEST_P(Surfaces, AFullDiskLeavesNothing) {
  const std::size_t size = readBytes(write("whole")).size();
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const std::size_t room : {std::size_t{10}, size / 2, size - 1}) {
    const rlimit full{.rlim_cur = room, .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    const std::string message = test::messageOf<std::runtime_error>([&] { write("full"); });
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
  }
}

std::string firstBytes(const fs::path& file, std::size_t count) { return readBytes(file).substr(0, count); }

TEST(SurfaceMarks, M2_StlSaysTheSpaceInItsHeader) {
  const TempFolder folder;
  writeMesh(twoTissues(), folder / "a.stl");
  EXPECT_EQ(firstBytes(folder / "a.stl", 80), "Sinew SPACE=LPS" + std::string(65, ' '));
  writeMesh(twoTissues(), folder / "a.stl", {.space = Space::Ras});
  EXPECT_TRUE(readBytes(folder / "a.stl").starts_with("Sinew SPACE=RAS "));
  writeMesh(twoTissues(), folder / "a.stl", {.spaceTag = false});
  EXPECT_TRUE(readBytes(folder / "a.stl").starts_with("Sinew   "));
}

TEST(SurfaceMarks, M2_PlyAndObjSayTheSpaceInAComment) {
  const TempFolder folder;
  writeMesh(twoTissues(), folder / "a.ply", {.space = Space::Ras});
  EXPECT_NE(readBytes(folder / "a.ply").find("\ncomment SPACE=RAS\n"), std::string::npos);
  writeMesh(twoTissues(), folder / "a.obj");
  EXPECT_NE(readBytes(folder / "a.obj").find("\n# SPACE=LPS\n"), std::string::npos);
  for (const char* name : {"a.ply", "a.obj"}) {
    writeMesh(twoTissues(), folder / name, {.spaceTag = false});
    EXPECT_EQ(readBytes(folder / name).find("SPACE"), std::string::npos);
    writeMesh(twoTissues(), folder / name, {.perMm = 0.1});
    EXPECT_EQ(readBytes(folder / name).find("SPACE"), std::string::npos) << "Slicer knows no centimetres";
  }
}

TEST(SurfaceMarks, M1_VtpSaysTheSpaceAndTheNames) {
  const TempFolder folder;
  writeMesh(twoTissues(), folder / "a.vtp", {.space = Space::Ras});
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "a.vtp").c_str());
  reader->Update();
  vtkFieldData* field = reader->GetOutput()->GetFieldData();
  auto* space = vtkStringArray::SafeDownCast(field->GetAbstractArray("SPACE"));
  ASSERT_NE(space, nullptr);
  EXPECT_EQ(space->GetValue(0), "RAS");
  EXPECT_EQ(vtkStringArray::SafeDownCast(field->GetAbstractArray("tissue_names"))->GetValue(1), "Müskel");
  vtkCellData* cells = reader->GetOutput()->GetCellData();
  EXPECT_STREQ(cells->GetScalars()->GetName(), "labels");
  std::set<std::pair<double, double>> labelAndRed;
  for (vtkIdType t = 0; t < reader->GetOutput()->GetNumberOfCells(); ++t)
    labelAndRed.insert({cells->GetScalars()->GetComponent(t, 0), cells->GetArray("RGB")->GetComponent(t, 0)});
  EXPECT_EQ(labelAndRed, (std::set<std::pair<double, double>>{{-7, 255}, {300, 51}}));
}

TEST(SurfaceMarks, ObjHasAGroupForEachTissue) {
  const TempFolder folder;
  writeMesh(twoTissues(), folder / "a.obj");
  const std::string bytes = readBytes(folder / "a.obj");
  EXPECT_NE(bytes.find("\ng bone_\"left\"_<a&b>\nv "), std::string::npos);
  EXPECT_NE(bytes.find("\ng Müskel\nv "), std::string::npos);
}

}  // namespace
}  // namespace sinew
