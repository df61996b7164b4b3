#include "sinew/MeshIO/TriangleFile.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

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

double volumeInside(const TriangleMesh& mesh) {
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
    EXPECT_DOUBLE_EQ(volumeInside(mesh), 1.5 * 1.5 * 1.5 / 6);  // positive: turned outwards
  }
}

std::string binaryStl(std::uint32_t facets, const std::vector<float>& numbers, const std::string& comment) {
  std::string bytes = comment + std::string(80 - comment.size(), ' ');
  bytes.append(reinterpret_cast<const char*>(&facets), sizeof facets);
  for (std::size_t facet = 0; facet + 12 <= numbers.size(); facet += 12)
    bytes.append(reinterpret_cast<const char*>(&numbers[facet]), 48).append(2, '\0');
  return bytes;
}

TEST(TriangleFile, ReadsBinaryStlAlsoWhenItsCommentSaysSolid) {
  const test::TempFolder folder;
  const std::vector<float> tet{0,   0, 0,   0, 0, 0, 0, 1.5, 0, 1.5, 0, 0,   0, 0, 0, 0,
                               0,   0, 1.5, 0, 0, 0, 0, 1.5, 0, 0,   0, 0,   0, 0, 0, 0,
                               1.5, 0, 1.5, 0, 0, 0, 0, 1.5, 0, 0,   0, 1.5, 0, 0, 0, 1.5};
  for (const char* comment : {"made by hand", "solid of binary"}) {
    test::writeBytes(folder / "tet.stl", binaryStl(4, tet, comment));
    const TriangleMesh mesh = readTriangleMesh(folder / "tet.stl");
    EXPECT_EQ(mesh.nodes.size(), 4u);
    EXPECT_DOUBLE_EQ(volumeInside(mesh), 1.5 * 1.5 * 1.5 / 6);
  }
}

TEST(TriangleFile, ReadsEveryWayToWriteObj) {
  const test::TempFolder folder;
  test::writeBytes(folder / "a.obj",
                   "v 0 0 0 1\r\nv +1 0 0 0.5 0.5 0.5\nv 0 \\\n1e0 0\nf -3//1 -2/1 3\nv 9 9 9\nl 1 2\nf");
  const TriangleMesh mesh = readTriangleMesh(folder / "a.obj");
  EXPECT_EQ(mesh.nodes, (std::vector<Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
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

/// VTK's readers crashed on some of these, or took them for what they are not.
TEST(TriangleFile, DamageIsNamedWithItsPlace) {
  const test::TempFolder folder;
  const std::vector<float> nowhere{0, 0, 0, 0, 0, 0, INFINITY, 0, 0, 0, 1, 0};
  const std::string damages = "damaged or not an .stl file (";
  for (const auto& [name, bytes, what] :
       std::initializer_list<std::tuple<const char*, std::string, std::string>>{
           {"a.obj", "v 0vt 0 0\nf 1 1 1\n", "line 1: a vertex needs three finite numbers"},
           {"a.obj", "v 0 0\n", "line 1: a vertex needs three finite numbers"},
           {"a.obj", "v 0 0 nan\n", "line 1: a vertex needs three finite numbers"},
           {"a.obj", "v 0 0 \\\n0\nf 1 2 1\n", "line 3: a polygon names a node that is not there"},
           {"a.obj", "v 0 0 0\nf 0 1 1\n", "line 2: a polygon names a node that is not there"},
           {"a.obj", "v 0 0 0\nf -2 1 1\n", "line 2: a polygon names a node that is not there"},
           {"a.obj", "v 0 0 0\nf 99999999999999999999 1 1\n",
            "line 2: a polygon names a node that is not there"},
           {"a.obj", "v 0 0 0\nf x 1 1\n", "line 2: a polygon names a node that is not there"},
           {"a.stl", binaryStl(1u << 31, {}, ""), damages + "it is too short for its 2147483648 facets)"},
           {"a.stl", binaryStl(1, nowhere, ""), "facet 0 has no finite coordinates"},
           {"a.stl", "solid a\n" + stlFacet(kO, kX, "0 1 x"), "facet 0 has no finite coordinates"},
           {"a.stl", "solid a\nvertex 0 0 0\nendfacet\n", "line 3: a facet has not three corners"},
           {"a.stl", "solid a\nvertex 0 0 0\nendsolid\n", damages + "it ends too early)"},
           {"a.stl", "solid a\n" + stlFacet(kO, kX, kY), damages + "it ends too early)"}}) {
    test::writeBytes(folder / name, bytes);
    const std::string message =
        test::messageOf<std::runtime_error>([&, file = folder / name] { readTriangleMesh(file); });
    EXPECT_EQ(message, (folder / name).string() + ": " + what) << bytes;
  }
}

/// VTK took the bytes of so many corners for none, and wrote behind them.
TEST(TriangleFile, OffsetsBeyondAnyMemoryAreDamage) {
  const test::TempFolder folder;
  std::string bytes = kVtp;
  for (const auto& [before, after] :
       {std::pair("3 6 9 12", "3 6 9 2305843009213693952"),  // 2^61, 8 bytes each
        {"Int32", "Int64"},
        {"Int32", "Int64"}})
    bytes.replace(bytes.find(before), std::string(before).size(), after);
  test::writeBytes(folder / "a.vtp", bytes);
  const std::string message =
      test::messageOf<std::runtime_error>([&] { readTriangleMesh(folder / "a.vtp"); });
  EXPECT_TRUE(message.starts_with((folder / "a.vtp: damaged or not a surface mesh (").string())) << message;
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
