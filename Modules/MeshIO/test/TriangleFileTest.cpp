#include "sinew/MeshIO/TriangleFile.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// The tet with the corners 0, e1, e2, e3, its faces turned outwards, in every format; numbers have a
/// fraction.
const std::string kObj =
    "# a comment\nv 0 0 0\nv 1.5 0 0\nv 0 1.5 0\nv 0 0 1.5\nv 9 9 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string kDecoratedObj =
    "mtllib none.mtl\no tet\nv 0 0 0\nv 1.5 0 0\nv 0 1.5 0\nv 0 0 1.5\nvt 0 0\nvt 1 0\nvn 0 0 1\ng faces\n"
    "f 1/1/1 3/1/1 2/1/1\nf 1/2/1 2/1/1 4/1/1\nf 1/1/1 4/1/1 3/1/1\nf 2/2/1 3/1/1 4/1/1\n";
const std::string kVtp =
    "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"4\">"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
    "0 0 0 1.5 0 0 0 1.5 0 0 0 1.5</DataArray></Points>"
    "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1 0 1 3 0 3 2 1 2 "
    "3</DataArray>"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray></Polys>"
    "</Piece></PolyData></VTKFile>\n";

std::string stlFacet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
         "\nendloop\nendfacet\n";
}
const std::string kO = "0 0 0", kX = "1.5 0 0", kY = "0 1.5 0", kZ = "0 0 1.5";
const std::string kStl = "solid tet\n" + stlFacet(kO, kY, kX) + stlFacet(kO, kX, kZ) + stlFacet(kO, kZ, kY) +
                         stlFacet(kX, kY, kZ) + "endsolid tet\n";

double enclosedVolume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.nodes[a].dot(mesh.nodes[b].cross(mesh.nodes[c])) / 6;
  return volume;
}

TEST(TriangleFile, ReadsEveryFormat) {
  const test::TempFolder folder;
  for (const auto& [name, text] :
       {std::pair("tet.obj", kObj), {"decorated.obj", kDecoratedObj}, {"tet.vtp", kVtp}, {"tet.stl", kStl}}) {
    SCOPED_TRACE(name);
    test::writeBytes(folder / name, text);
    const TriangleMesh mesh = readTriangleMesh(folder / name);
    EXPECT_EQ(mesh.nodes.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_DOUBLE_EQ(enclosedVolume(mesh), 1.5 * 1.5 * 1.5 / 6);  // positive: turned outwards
  }
}

TEST(TriangleFile, LargerPolygonsBecomeFans) {
  const test::TempFolder folder;
  test::writeBytes(folder / "pentagon.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 2 0\nv -1 1 0\nf 1 2 3 4 5\n");
  const TriangleMesh mesh = readTriangleMesh(folder / "pentagon.obj");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(TriangleFile, PointsAtTheSamePlaceAreOneNode) {
  const test::TempFolder folder;
  test::writeBytes(folder / "seam.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\nf 2 4 6\n");
  const TriangleMesh mesh = readTriangleMesh(folder / "seam.obj");
  EXPECT_EQ(mesh.nodes.size(), 4u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));  // the third one was a line
}

TEST(TriangleFile, WhatCannotBeReadIsNamedInOneLine) {
  const test::TempFolder folder;
  test::writeBytes(folder / "empty.obj", "");
  test::writeBytes(folder / "points.obj", "v 0 0 0\nv 1 0 0\n");
  test::writeBytes(folder / "damaged.vtp", kVtp.substr(0, kVtp.size() / 2));
  test::writeBytes(folder / "text.stl", "some words\n");
  test::writeBytes(folder / "tet.off", "OFF\n");
  for (const auto& [name, what] : {std::pair("missing.obj", "no such file"),
                                   {"empty.obj", "has no polygons"},
                                   {"points.obj", "has no polygons"},
                                   {"damaged.vtp", "damaged"},
                                   {"text.stl", ""},
                                   {"tet.off", ".obj, .ply, .stl and .vtp can be read"}}) {
    const std::string message =
        test::messageOf<std::runtime_error>([&, n = name] { readTriangleMesh(folder / n); });
    EXPECT_EQ(message.find((folder / name).string()), 0u) << name << ": " << message;
    EXPECT_NE(message.find(what), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace sinew
