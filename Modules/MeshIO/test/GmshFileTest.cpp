#include "GmshFile.h"
#include "SolverMeshes.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <sstream>

namespace sinew {
namespace {

namespace fs = std::filesystem;
using test::readBytes;
using test::TempFolder;
using test::writeBytes;

/// Two tets, nodes with gaps in their numbers and out of order, a triangle and a node that no tet has.
const std::string kByHand =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n2\n2 5 \"skin\"\n3 5 \"a \"b\" c\"\n$EndPhysicalNames\n"
    "$Nodes\n6\n10 1 0 0\n3 0 0 0\n7 0 1 0\n8 0 0 1\n20 1 1 1\n99 5 5 5\n$EndNodes\n"
    "$Elements\n4\n1 2 2 5 1 3 7 10\n2 4 2 5 1 3 10 7 8\n3 4 3 0 6 0 10 7 8 20\n4 15 2 1 1 99\n$EndElements\n"
    "$NodeData\n1\n\"x\"\n$EndNodeData\n";

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// kByHand as Gmsh writes it with -bin: elements of one type in blocks.
std::string binaryByHand() {
  std::string bytes = "$MeshFormat\n2.2 1 8\n";
  append(bytes, 1);
  bytes += "\n$EndMeshFormat\n$Nodes\n5\n";
  const auto node = [&](int id, double x, double y, double z) {
    append(bytes, id);
    for (const double value : {x, y, z}) append(bytes, value);
  };
  node(10, 1, 0, 0), node(3, 0, 0, 0), node(7, 0, 1, 0), node(8, 0, 0, 1), node(20, 1, 1, 1);
  bytes += "\n$EndNodes\n$Elements\n3\n";
  for (const int value : {2, 1, 2, 1, 5, 1, 3, 7, 10}) append(bytes, value);
  for (const int value : {4, 2, 2, 2, 5, 1, 3, 10, 7, 8, 3, 0, 6, 10, 7, 8, 20}) append(bytes, value);
  return bytes + "\n$EndElements\n";
}

class GmshFile : public ::testing::Test {
 protected:
  TissueMesh readText(const std::string& text) {
    writeBytes(folder_ / "a.msh", text);
    return readMesh(folder_ / "a.msh");
  }
  std::string messageOf(const std::string& text) {
    return test::messageOf<std::runtime_error>([&] { readText(text); });
  }
  TempFolder folder_;
};

TEST_F(GmshFile, KeepsEveryBitOnTheWayThere) {
  const TissueMesh mesh = test::twoHalves();
  writeMesh(mesh, folder_ / "a.msh");
  const TissueMesh read = readMesh(folder_ / "a.msh");
  EXPECT_EQ(read.mesh.nodes, mesh.mesh.nodes);
  EXPECT_EQ(read.mesh.tets, mesh.mesh.tets);
  EXPECT_EQ(read.mesh.labels, mesh.mesh.labels);
  ASSERT_EQ(read.regions.size(), 2u);
  EXPECT_EQ(read.regions[0].label, 3);
  EXPECT_EQ(read.regions[0].name, "right half");
  EXPECT_EQ(read.regions[1].name, "left half");
}

TEST_F(GmshFile, UnitsAndSpacesComeBackAsLpsMillimetres) {
  const TissueMesh mesh = test::twoHalves();
  for (const double perMm : {0.1, 0.001, 2.5})
    for (const Space space : {Space::Lps, Space::Ras}) {
      WriteMeshOptions options;
      options.perMm = perMm;
      options.space = space;
      writeMesh(mesh, folder_ / "a.msh", options);
      const TissueMesh read = readMesh(folder_ / "a.msh");
      for (std::size_t n = 0; n < mesh.mesh.nodes.size(); ++n)
        ASSERT_LT((read.mesh.nodes[n] - mesh.mesh.nodes[n]).norm(), 1e-12 * 1000);
    }
}

TEST_F(GmshFile, MetresAndRasAreInTheCoordinates) {
  TissueMesh mesh = test::namedTets({"a"});
  WriteMeshOptions options;
  options.perMm = 0.001;
  options.space = Space::Ras;
  writeMesh(mesh, folder_ / "a.msh", options);
  const std::string text = readBytes(folder_ / "a.msh");
  EXPECT_NE(text.find("\n2 -0.001 -0 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("Sinew mesh, unit m, space RAS\n"), std::string::npos);
}

TEST_F(GmshFile, BoundaryTrianglesCloseEveryTissue) {
  const TissueMesh mesh = test::twoHalves();
  writeMesh(mesh, folder_ / "a.msh");
  std::istringstream text(readBytes(folder_ / "a.msh"));
  std::map<int, Eigen::Vector3d> areas;
  std::map<int, double> volumes;
  const auto x = [&](int node) { return mesh.mesh.nodes[node - 1]; };
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    int number = 0, type = 0, tags = 0, first = 0, second = 0, a = 0, b = 0, c = 0;
    if (!(words >> number >> type >> tags >> first >> second >> a >> b >> c) || type != 2 || tags != 2)
      continue;
    EXPECT_EQ(first, second);
    areas.try_emplace(first, Eigen::Vector3d::Zero()).first->second += (x(b) - x(a)).cross(x(c) - x(a)) / 2;
    volumes[first] += (x(a) - x(1)).dot((x(b) - x(1)).cross(x(c) - x(1))) / 6;
  }
  ASSERT_EQ(areas.size(), 2u);
  std::map<int, double> tetVolumes;
  for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.mesh.tets[t];
    const auto& n = mesh.mesh.nodes;
    tetVolumes[mesh.mesh.labels[t]] += (n[b] - n[a]).cross(n[c] - n[a]).dot(n[d] - n[a]) / 6;
  }
  for (const int label : {3, 7}) {
    EXPECT_LT(areas[label].norm(), 1e-9);                  // closed
    EXPECT_NEAR(volumes[label], tetVolumes[label], 1e-9);  // and outwards
  }
}

TEST_F(GmshFile, CurvedTetsComeBackStraight) {
  const TissueMesh mesh = test::twoHalves();
  WriteMeshOptions options;
  options.quadratic = true;
  writeMesh(mesh, folder_ / "a.msh", options);
  const TissueMesh read = readMesh(folder_ / "a.msh");
  EXPECT_EQ(read.mesh.nodes, mesh.mesh.nodes);
  EXPECT_EQ(read.mesh.tets, mesh.mesh.tets);
}

/// Gmsh's manual draws the middles of a Tetrahedron10 as 01, 12, 02, 03, 23, 13.
TEST_F(GmshFile, MiddlesAreInGmshsOrder) {
  TissueMesh mesh = test::namedTets({"a"});
  WriteMeshOptions options;
  options.quadratic = true;
  writeMesh(mesh, folder_ / "a.msh", options);
  const std::string text = readBytes(folder_ / "a.msh");
  std::istringstream words(text.substr(text.find("\n1 11 2 1 1 ") + 12));
  std::array<int, 10> nodes{};
  for (int& node : nodes) words >> node;
  const auto place = [&](int node) {
    const std::string line = std::string("\n").append(std::to_string(node)).append(" ");
    std::istringstream at(text.substr(text.find(line, text.find("$Nodes\n10\n") + 8)));
    Eigen::Vector3d x;
    at >> node >> x[0] >> x[1] >> x[2];
    return x;
  };
  constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
  for (int e = 0; e < 6; ++e)
    EXPECT_EQ(place(nodes[4 + e]), (place(nodes[kEdges[e][0]]) + place(nodes[kEdges[e][1]])) / 2) << e;
}

TEST_F(GmshFile, LabelsBelowOneGetNumbersThatAreFree) {
  TissueMesh mesh = test::namedTets({"zero", "four", "minus"});
  mesh.mesh.labels = {0, 4, -7};
  for (int r = 0; r < 3; ++r) mesh.regions[r].label = mesh.mesh.labels[r];
  writeMesh(mesh, folder_ / "a.msh");
  const TissueMesh read = readMesh(folder_ / "a.msh");
  EXPECT_EQ(read.mesh.labels, (std::vector<std::int32_t>{5, 4, 6}));
  EXPECT_EQ(read.regions[1].name, "zero");
  EXPECT_EQ(read.regions[2].name, "minus");
}

TEST_F(GmshFile, HardNamesStayDistinctAndShort) {
  const auto names = test::hardNames();
  writeMesh(test::namedTets(names), folder_ / "a.msh");
  const TissueMesh read = readMesh(folder_ / "a.msh");
  std::set<std::string> found;
  for (const TissueRegion& region : read.regions) {
    EXPECT_TRUE(found.insert(region.name).second) << region.name;
    EXPECT_LE(region.name.size() + std::string(" boundary").size(), 127u);
  }
  ASSERT_EQ(found.size(), names.size());
  EXPECT_EQ(read.regions[0].name, "a _quoted_ 'name'");
  EXPECT_EQ(read.regions[1].name, "M\u00fcller/Gro\u00df");
  EXPECT_EQ(read.regions[7].name, "Segment_8");
}

TEST_F(GmshFile, ReadsWhatOthersWrite) {
  const TissueMesh mesh = readText(kByHand);
  const std::vector<Eigen::Vector3d> nodes{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  EXPECT_EQ(mesh.mesh.nodes, nodes);
  EXPECT_EQ(mesh.mesh.tets, (std::vector<Tet>{{1, 0, 2, 3}, {0, 2, 3, 4}}));
  EXPECT_EQ(mesh.mesh.labels, (std::vector<std::int32_t>{5, 6}));
  ASSERT_EQ(mesh.regions.size(), 2u);
  EXPECT_EQ(mesh.regions[0].name, "a \"b\" c");
  EXPECT_EQ(mesh.regions[1].name, "Segment_6");
}

TEST_F(GmshFile, ReadsBinaryFiles) {
  const TissueMesh text = readText(kByHand), binary = readText(binaryByHand());
  EXPECT_EQ(binary.mesh.nodes, text.mesh.nodes);
  EXPECT_EQ(binary.mesh.tets, text.mesh.tets);
  EXPECT_EQ(binary.mesh.labels, text.mesh.labels);
}

TEST_F(GmshFile, ReadsLinesThatEndAsOnWindows) {
  std::string text;
  for (const char c : kByHand) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(readText(text).mesh.tets, readText(kByHand).mesh.tets);
}

struct Damage {
  const char* what;
  std::string from, to, message;
};

TEST_F(GmshFile, DamagedFilesEndInOneLine) {
  const std::vector<Damage> damages{
      {"no Gmsh file", "$MeshFormat\n", "hello\n", "line 1: not a Gmsh file"},
      {"newer", "2.2 0 8", "4.1 0 8", "is Gmsh 4.1; 2.2 can be read"},
      {"many nodes", "$Nodes\n6", "$Nodes\n1000000000", "promises 1000000000 entries"},
      {"more nodes", "$Nodes\n6", "$Nodes\n9", "expected a number"},
      {"fewer nodes", "$Nodes\n6", "$Nodes\n5", "expected $EndNodes"},
      {"negative count", "$Elements\n4", "$Elements\n-4", "promises -4 entries"},
      {"huge count", "$Elements\n4", "$Elements\n99999999999999999999", "expected a number"},
      {"unknown node", "3 10 7 8\n", "3 10 7 11\n", "names node 11, which is not there"},
      {"twice", "7 0 1 0", "3 0 1 0", "has two nodes 3"},
      {"nowhere", "0 0 1\n20", "0 nan 1\n20", "node 8 has no finite coordinates"},
      {"tags", "2 4 2 5 1", "2 4 2000000000 5 1", "has 2000000000 tags"},
      {"label", "2 4 2 5 1", "2 4 2 99999999999 1", "expected a number"},
      {"no end", "$EndNodeData", "", "has no $EndNodeData"},
      {"no section", "$NodeData", "NodeData", "expected a section"},
      {"no quotes", "2 5 \"skin\"", "2 5 skin", "expected a name in quotes"},
      {"no tets", "4\n1 2 2 5 1 3 7 10\n2 4 2 5 1 3 10 7 8\n3 4 3 0 6 0 10 7 8 20\n4 15 2 1 1 99\n", "0\n",
       "has no tetrahedra"},
  };
  for (const Damage& damage : damages) {
    std::string text = kByHand;
    text.replace(text.find(damage.from), damage.from.size(), damage.to);
    const std::string message = messageOf(text);
    EXPECT_TRUE(message.starts_with((folder_ / "a.msh").string() + ": ")) << damage.what << ": " << message;
    EXPECT_NE(message.find(damage.message), std::string::npos) << damage.what << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << damage.what;
  }
}

TEST_F(GmshFile, CutsAndChangedBytesAreReadOrRefused) {
  const auto readOrRefuse = [&](const std::string& bytes) {
    try {
      const TissueMesh mesh = readText(bytes);
      for (const Tet& tet : mesh.mesh.tets)
        for (const std::int32_t node : tet) ASSERT_LT(static_cast<std::size_t>(node), mesh.mesh.nodes.size());
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with((folder_ / "a.msh").string())) << error.what();
    }
  };
  constexpr std::string_view kBytes(
      "\xff\0"
      "9$",
      4);
  for (const std::string& whole : {kByHand, binaryByHand()})
    for (std::size_t at = 0; at < whole.size(); ++at) {
      if (at % 3 == 0) readOrRefuse(whole.substr(0, at));
      std::string changed = whole;
      changed[at] = kBytes[at % kBytes.size()];
      readOrRefuse(changed);
    }
}

TEST_F(GmshFile, NotesThatAreNoneAreComments) {
  const auto read = [&](const std::string& note) {
    return readText(kByHand + "$Comments\n" + note + "\n$EndComments\n").mesh.nodes[0].x();
  };
  EXPECT_EQ(read("Sinew mesh, unit cm, space LPS"), 10);
  EXPECT_EQ(read("some text\nSinew mesh, unit 0.5 to 1 mm, space RAS\r"), -2);
  for (const char* note :
       {"Sinew mesh, unit km, space LPS", "Sinew mesh, unit 0 to 1 mm, space LPS",
        "Sinew mesh, unit -1 to 1 mm, space LPS", "Sinew mesh, unit nan to 1 mm, space LPS",
        "Sinew mesh, unit mm, space XYZ", "Sinew mesh, unit , space LPS", "Sinew mesh"})
    EXPECT_EQ(read(note), 1) << note;
  std::string far = kByHand + "$Comments\nSinew mesh, unit 1e-300 to 1 mm, space LPS\n$EndComments\n";
  far.replace(far.find("7 0 1 0"), 7, "7 0 1e9 0");
  EXPECT_NE(messageOf(far).find("out of range"), std::string::npos);
}

TEST_F(GmshFile, BytesOfAnotherMachineAreNamed) {
  std::string bytes = binaryByHand();
  std::swap(bytes[bytes.find("2.2 1 8\n") + 8], bytes[bytes.find("2.2 1 8\n") + 11]);
  EXPECT_NE(messageOf(bytes).find("has its bytes in another order"), std::string::npos);
}

}  // namespace
}  // namespace sinew
