#include "Indenter.h"
#include "sinew/Mesher/MeshConditions.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// A block of cubes of 1 mm, of which those that `keeps` the middle of stay.
TetMesh blockWith(const Eigen::Vector3i& cubes, const std::function<bool(const Vector3d&)>& keeps) {
  TetMesh mesh = test::barMesh(cubes, 1);
  std::erase_if(mesh.tets, [&](const Tet& tet) {
    Vector3d middle = Vector3d::Zero();
    for (const std::int32_t v : tet) middle += mesh.nodes[static_cast<std::size_t>(v)] / 4;
    return !keeps(middle.array().floor() + 0.5);  // of its cube
  });
  return mesh;
}

Indenter indenterDown(const TetMesh& mesh, const Vector3d& middle) {
  return placeIndenter(mesh, middle, Vector3d::UnitZ(), Vector3d::UnitY());
}

/// The nodes whose surface faces along y (sign 1) or against it (-1), within 60 degrees.
std::vector<std::int32_t> facing(const TetMesh& mesh, double sign) {
  std::vector<Vector3d> normals(mesh.nodes.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : meshBoundary(mesh).triangles) {
    const auto at = [&](std::int32_t n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
    for (const std::int32_t n : {a, b, c})
      normals[static_cast<std::size_t>(n)] += (at(b) - at(a)).cross(at(c) - at(a));
  }
  std::vector<std::int32_t> nodes;
  for (std::size_t n = 0; n < normals.size(); ++n)
    if (sign * normals[n].normalized().y() > 0.5) nodes.push_back(static_cast<std::int32_t>(n));
  return nodes;
}

/// Those less far from the line of the push, through `middle`, than half the thickness.
std::vector<std::int32_t> nearLine(const TetMesh& mesh, std::vector<std::int32_t> nodes,
                                   const Vector3d& middle, double thickness) {
  std::erase_if(nodes, [&](std::int32_t n) {
    const Vector3d from = mesh.nodes[static_cast<std::size_t>(n)] - middle;
    return std::hypot(from.x(), from.z()) >= thickness / 2;
  });
  return nodes;
}

std::vector<std::int32_t> atHeight(const TetMesh& mesh, std::vector<std::int32_t> nodes, double y) {
  std::erase_if(nodes, [&](std::int32_t n) { return mesh.nodes[static_cast<std::size_t>(n)].y() != y; });
  return nodes;
}

// Of a convex body lines meet every side first or last: what faces the push decides alone.
TEST(Indenter, OfASolidBodyTakesAllThatFacesIt) {
  struct Row {
    TetMesh mesh;
    Vector3d middle;
  };
  for (const auto& [mesh, middle] :
       {Row{test::barMesh({8, 4, 8}, 1), {4, 2, 4}}, Row{test::spindleMesh({6, 6, 16}, 1), {3, 3, 8}}}) {
    const Indenter indenter = indenterDown(mesh, middle);
    EXPECT_EQ(indenter.patch, nearLine(mesh, facing(mesh, -1), middle, indenter.thickness));
    EXPECT_EQ(indenter.bed, facing(mesh, 1));
  }
}

/// Of a body from y = 0 to y = 6 with a cavity.
void expectOuterSidesOnly(const TetMesh& mesh) {
  const Vector3d middle(3, 3, 4);
  const Indenter indenter = indenterDown(mesh, middle);
  EXPECT_EQ(indenter.patch, nearLine(mesh, atHeight(mesh, facing(mesh, -1), 0), middle, 6));
  EXPECT_EQ(indenter.bed, atHeight(mesh, facing(mesh, 1), 6));
  EXPECT_LT(indenter.bed.size(), facing(mesh, 1).size());  // walls of the cavity face this way too
}

TetMesh squareTube() {
  return blockWith(
      {6, 6, 8}, [](const Vector3d& x) { return std::max(std::abs(x.x() - 3), std::abs(x.y() - 3)) > 1.5; });
}

TEST(Indenter, OfATubeTakesNothingOfTheLumen) { expectOuterSidesOnly(squareTube()); }

TEST(Indenter, OfAUTakesTheOuterSidesOfItsArms) {
  expectOuterSidesOnly(
      blockWith({6, 6, 8}, [](const Vector3d& x) { return x.x() < 2 || std::abs(x.y() - 3) > 1; }));
}

// Where rounding moves every node a little off the lines through the others.
TEST(Indenter, OfATurnedTubeTakesTheSame) {
  TetMesh mesh = squareTube();
  const Vector3d middle(3.1, 3, 4.2);  // no node is just as far from it as the radius
  const Indenter before = indenterDown(mesh, middle);
  const Eigen::AngleAxisd turn(1, Vector3d(1, 2, 3).normalized());
  for (Vector3d& node : mesh.nodes) node = turn * node;
  const Indenter turned =
      placeIndenter(mesh, turn * middle, turn * Vector3d::UnitZ(), turn * Vector3d::UnitY());
  EXPECT_EQ(turned.patch, before.patch);
  EXPECT_EQ(turned.bed, before.bed);
}

}  // namespace
}  // namespace sinew
