#include "Program.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/ElasticBars.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <cmath>
#include <csignal>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A bar of 4 x 4 x 12 mm along z. A contraction moves it only where it has tendon.
TissueMesh bar() { return {barMesh({4, 4, 12}, 1), {{1, "biceps", {0.8, 0.3, 0.3}}}, {}}; }

/// 6 x 6 x 2 mm across it, from a height on.
TissueMesh block(double z) {
  TissueMesh mesh{barMesh({6, 6, 2}, 1), {{2, "bone", {0.9, 0.9, 0.8}}}, {}};
  for (Eigen::Vector3d& x : mesh.mesh.nodes) x += Eigen::Vector3d(-1, -1, z);
  std::ranges::fill(mesh.mesh.labels, 2);
  return mesh;
}

TissueMesh barAndBlock() {
  TissueMesh both = bar();
  const TissueMesh bone = block(12.25);
  const auto first = static_cast<std::int32_t>(both.mesh.nodes.size());
  both.mesh.nodes.insert(both.mesh.nodes.end(), bone.mesh.nodes.begin(), bone.mesh.nodes.end());
  for (Tet tet : bone.mesh.tets) {
    for (std::int32_t& node : tet) node += first;
    both.mesh.tets.push_back(tet);
    both.mesh.labels.push_back(2);
  }
  both.regions.push_back(bone.regions[0]);
  return both;
}

const MeshArray& cellArray(const TissueMesh& mesh, const std::string& name) {
  return *std::ranges::find(mesh.arrays.cells, name, &MeshArray::name);
}

class Muscle : public ::testing::Test {
 protected:
  Muscle() { writeMesh(bar(), folder_ / "bar.vtu"); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  /// The line that a run fails with, without `sinew: ` and its end.
  static std::string failure(const std::vector<std::string>& arguments, int exitCode) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
    constexpr std::size_t start = 7;
    return result.err.size() > start ? result.err.substr(start, result.err.size() - start - 1) : result.err;
  }
  TempFolder folder_;
};

using FibresCommand = Muscle;
using SimulateCommand = Muscle;

TEST_F(FibresCommand, RunFromTheEndToTheOther) {
  for (const char* name : {"out.vtu", "out.vtk"}) {
    const ProgramResult result = run({"fibres", at("bar.vtu"), "-o", at(name), "--tendon", "0.2"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, at(name) + ": 1,152 fibres (harmonic), origin of 50 nodes, insertion of 50\n");
    const TissueMesh mesh = readMesh(at(name), {.cellArrays = true});
    const MeshArray& fibres = cellArray(mesh, "fibres");
    ASSERT_EQ(fibres.values.size(), 3 * mesh.mesh.tets.size());
    for (std::size_t i = 0; i < fibres.values.size(); i += 3) {
      EXPECT_NEAR(fibres.values[i + 2], -1, 1e-6);  // floats, down from the head
      EXPECT_NEAR(std::hypot(fibres.values[i], fibres.values[i + 1]), 0, 1e-6);
    }
    // Layers of six tets in each of 16 cubes: with nodes in the ends, or not.
    const auto marked = [&](float mark) {
      return std::ranges::count(cellArray(mesh, "attachment").values, mark);
    };
    EXPECT_EQ(marked(1), 2 * 96);
    EXPECT_EQ(marked(2), 2 * 96);
    EXPECT_EQ(cellArray(mesh, "tendon").values.front(), 1);
  }
}

TEST_F(FibresCommand, RunFromWhatTheTissueTouches) {
  writeMesh(block(12.25), folder_ / "top.vtu");
  writeMesh(barAndBlock(), folder_ / "both.vtu");
  const auto nodes = [&](const std::vector<std::string>& where, const std::string& mesh) {
    std::vector<std::string> arguments{"fibres", at(mesh), "-o", at("o.vtu"), "--force", "--json", "-"};
    arguments.insert(arguments.end(), where.begin(), where.end());
    const Json json = Json::parse(run(arguments).out);
    return std::pair(json["origin_nodes"].get<int>(), json["insertion_nodes"].get<int>());
  };
  EXPECT_EQ(nodes({"--origin", at("top.vtu")}, "bar.vtu"), std::pair(25, 50)) << "its top, and the lower end";
  EXPECT_EQ(nodes({"--insertion", at("top.vtu")}, "bar.vtu"), std::pair(50, 25));
  EXPECT_EQ(nodes({"--origin", "Bone", "--label", "biceps"}, "both.vtu"), std::pair(25, 50));
  EXPECT_EQ(nodes({"--origin", "2", "--label", "1"}, "both.vtu"), std::pair(25, 50));
  EXPECT_EQ(nodes({"--origin", at("top.vtu"), "--insertion", "box:-1,-1,-1,9,9,0.5"}, "bar.vtu"),
            std::pair(25, 25));
}

TEST_F(FibresCommand, FollowASplineInTheFilesSpace) {
  // A box whose w leans: fibres along (10, 0, 20) in RAS, the bar lies in LPS.
  writeBytes(folder_ / "s.json",
             R"({"counts": [2, 2, 2], "space": "RAS", "points": [[-9,-9,-1],[9,-9,-1],[-9,9,-1],[9,9,-1],)"
             R"([1,-9,19],[19,-9,19],[1,9,19],[19,9,19]]})");
  ASSERT_EQ(
      run({"fibres", at("bar.vtu"), "-o", at("o.vtu"), "--spline", at("s.json"), "--space", "RAS"}).exitCode,
      0);
  const MeshArrays arrays = readMesh(at("o.vtu"), {.cellArrays = true}).arrays;
  const std::vector<float>& values = std::ranges::find(arrays.cells, "fibres", &MeshArray::name)->values;
  EXPECT_NEAR(values[0], -1 / std::sqrt(5.), 1e-6);
  EXPECT_NEAR(values[2], 2 / std::sqrt(5.), 1e-6);
}

std::string boxSpline(double from) {
  std::string points;
  for (const double z : {from, from + 14})
    for (const double y : {-1., 5.})
      for (const double x : {-1., 5.})
        points += (points.empty() ? "[" : ",[") + std::to_string(x) + ',' + std::to_string(y) + ',' +
                  std::to_string(z) + ']';
  return R"({"counts": [2, 2, 2], "space": "LPS", "points": [)" + points + "]}";
}

TEST_F(FibresCommand, CountTheTetsOutsideOfASpline) {
  const auto fibres = [&](double from) {
    writeBytes(folder_ / "s.json", boxSpline(from));
    return run({"fibres", at("bar.vtu"), "-o", at("o.vtu"), "--spline", at("s.json"), "--force", "--json",
                "-", "--quiet"});
  };
  EXPECT_EQ(Json::parse(fibres(-1).out)["tets_outside_spline"], 0);
  const int part = Json::parse(fibres(4).out)["tets_outside_spline"];
  EXPECT_EQ(part, 3 * 96) << "centroids of the fourth layer lie nearer than the mean edge, 1.1 mm";
  writeBytes(folder_ / "s.json", boxSpline(4));
  const ProgramResult warned =
      run({"fibres", at("bar.vtu"), "-o", at("o.vtu"), "--spline", at("s.json"), "--force"});
  EXPECT_EQ(warned.err,
            at("bar.vtu") + ": " + std::to_string(part) +
                " of 1,152 tets lie outside of the spline; its nearest points tell their fibres\n");
  writeBytes(folder_ / "s.json", boxSpline(400));
  EXPECT_EQ(failure({"fibres", at("bar.vtu"), "-o", at("p.vtu"), "--spline", at("s.json")}, 1),
            at("bar.vtu") + ": --spline " + at("s.json") +
                ": all tets lie outside of the solid; are its points in mm, and its space right?");
}

TEST_F(FibresCommand, RefuseAMeshWhoseEndsLieOnDifferentPieces) {
  TissueMesh mesh = barAndBlock();
  std::ranges::fill(mesh.mesh.labels, 1);
  mesh.regions.resize(1);
  writeMesh(mesh, folder_ / "pieces.vtu");
  EXPECT_EQ(
      failure({"fibres", at("pieces.vtu"), "-o", at("o.vtu"), "--ends", "0.1"}, 1),
      at("pieces.vtu") +
          ": no tet gets a fibre: no piece of the mesh reaches from the origin to the insertion; choose "
          "both on its largest piece, with --origin and --insertion");
  EXPECT_FALSE(fs::exists(at("o.vtu")));
}

TEST_F(FibresCommand, StayWhenTheMeshIsConverted) {
  ASSERT_EQ(run({"fibres", at("bar.vtu"), "-o", at("f.vtu"), "--ends", "0.2"}).exitCode, 0);
  ASSERT_EQ(run({"convert", at("f.vtu"), at("g.vtk"), "--space", "RAS"}).exitCode, 0);
  const auto fibres = [&](const char* name) {
    return cellArray(readMesh(at(name), {.cellArrays = true}), "fibres").values;
  };
  EXPECT_EQ(fibres("g.vtk"), fibres("f.vtu"));
}

TEST_F(FibresCommand, ErrorsSayWhatAndWhere) {
  writeMesh(block(15), folder_ / "far.vtu");
  writeMesh(barAndBlock(), folder_ / "both.vtu");
  const auto refusal = [&](std::vector<std::string> arguments, int exitCode = 1) {
    arguments.insert(arguments.begin() + 1, {"-o", at("o.vtu")});
    arguments.insert(arguments.begin(), "fibres");
    return failure(arguments, exitCode);
  };
  EXPECT_EQ(refusal({at("bar.vtu"), "--origin", at("far.vtu"), "--contact", "0.5"}),
            at("bar.vtu") + ": --origin " + at("far.vtu") +
                ": no node lies within 0.5 mm; the nearest is 3 mm away");
  EXPECT_EQ(refusal({at("bar.vtu"), "--origin", "ulna"}),
            at("bar.vtu") + ": --origin ulna: neither a mesh file, a tissue of this mesh, nor a box");
  EXPECT_EQ(refusal({at("bar.vtu"), "--insertion", "box:1,2,3"}),
            at("bar.vtu") + ": --insertion box:1,2,3: a box is box:X,Y,Z,X,Y,Z, two corners in mm");
  EXPECT_EQ(
      refusal({at("bar.vtu"), "--origin", "box:0,0,0,4,4,12"}),
      at("bar.vtu") +
          ": origin and insertion share 50 nodes; choose attachments that lie apart, or that reach less far");
  EXPECT_EQ(refusal({at("bar.vtu"), "--ends", "0.6"}, 2),
            "--ends: a share of 0.6; it must be above 0 and below 0.5");
  EXPECT_EQ(refusal({at("both.vtu")}),
            at("both.vtu") + ": holds 2 tissues; choose one of them with --label: biceps (1), bone (2)");
  EXPECT_EQ(refusal({at("both.vtu"), "--label", "ulna"}),
            at("both.vtu") + ": has no tissue ulna; it has biceps (1), bone (2)");
  EXPECT_EQ(refusal({at("bar.vtu"), "--spline", at("none.json")}),
            at("none.json") + ": no such file, or not readable");
  EXPECT_EQ(failure({"fibres", at("bar.vtu"), "-o", at("o.msh")}, 2),
            "--output: " + at("o.msh") + ": fibres are written as .vtu and .vtk");
  EXPECT_FALSE(fs::exists(at("o.vtu")));
}

/// Elements of an XML file by their names.
int countElements(const fs::path& file, const std::string& name) {
  const vtkNew<vtkXMLDataParser> parser;
  parser->SetFileName(file.c_str());
  EXPECT_NE(parser->Parse(), 0) << file;
  const auto count = [&](const auto& self, vtkXMLDataElement* element) -> int {
    int sum = element->GetName() == name ? 1 : 0;
    for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
      sum += self(self, element->GetNestedElement(i));
    return sum;
  };
  return count(count, parser->GetRootElement());
}

TEST_F(SimulateCommand, ContractsAndWritesWhatItSaw) {
  const ProgramResult result = run(
      {"simulate", at("bar.vtu"), "--contract", "0.5", "--tendon", "0.15", "--frames", "4", "-o", at("out")});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("bar.vtu: contraction completes: ")) << result.out;
  EXPECT_EQ(std::ranges::count(result.out, '\n'), 1);
  EXPECT_EQ(namesIn(folder_ / "out"),
            (std::vector<std::string>{"contract-000.vtu", "contract-001.vtu", "contract-002.vtu",
                                      "contract-003.vtu", "contract-004.vtu", "contract.csv", "contract.pvd",
                                      "contract.svg", "report.json"}));
  EXPECT_EQ(countElements(folder_ / "out" / "contract.pvd", "DataSet"), 5);
  EXPECT_EQ(countElements(folder_ / "out" / "contract.svg", "polyline"), 6);
  EXPECT_EQ(std::ranges::count(readBytes(folder_ / "out" / "contract.csv"), '\n'), 6);

  const TissueMesh top = readMesh(folder_ / "out" / "contract-002.vtu", {.cellArrays = true});
  EXPECT_EQ(top.mesh.tets, bar().mesh.tets);
  EXPECT_EQ(cellArray(top, "fibres").components, 3);
  const Json report = Json::parse(readBytes(folder_ / "out" / "report.json"));
  const Json& mesh = report["meshes"][0];
  EXPECT_EQ(report["trial"], "contract");
  EXPECT_EQ(report["options"]["amount"], 0.5);
  EXPECT_EQ(mesh["tissue"], "biceps");
  EXPECT_EQ(mesh["fibres"], "harmonic");
  EXPECT_TRUE(mesh["completed"]);
  EXPECT_EQ(mesh["frames"], 5);
  const auto& ratios = cellArray(top, "aspect_ratio").values;
  EXPECT_NEAR(*std::ranges::max_element(ratios), mesh["max_aspect_ratio"].get<double>(), 1e-4);  // floats
  const auto& J = cellArray(top, "J").values;
  EXPECT_LT(*std::ranges::min_element(J), 1);
}

TEST_F(SimulateCommand, TakesTheFibresOfTheMesh) {
  ASSERT_EQ(
      run({"fibres", at("bar.vtu"), "-o", at("f.vtu"), "--insertion", "box:0,0,0,4,4,1", "--tendon", "0.1"})
          .exitCode,
      0);
  ASSERT_EQ(
      run({"simulate", at("f.vtu"), "--contract", "0.2", "--frames", "2", "--no-series", "-o", at("out")})
          .exitCode,
      0);
  EXPECT_EQ(namesIn(folder_ / "out"),
            (std::vector<std::string>{"contract.csv", "contract.svg", "report.json"}));
  const Json report = Json::parse(readBytes(folder_ / "out" / "report.json"));
  EXPECT_EQ(report["meshes"][0]["fibres"], "mesh");
}

TEST_F(SimulateCommand, ComparesMeshesWorstFirst) {
  fs::create_directory(folder_ / "b");
  TissueMesh skewed = bar();
  for (Eigen::Vector3d& x : skewed.mesh.nodes) x.x() += 0.7 * std::sin(x.z() * 1.57) * std::sin(x.y() * 0.78);
  writeMesh(skewed, folder_ / "b" / "bar.vtu");
  const ProgramResult result = run({"simulate", "--compare", at("bar.vtu"), at("b/bar.vtu"), "--stretch=0.2",
                                    "--frames", "2", "-o", at("out"), "--threads", "1"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json report = Json::parse(readBytes(folder_ / "out" / "report.json"));
  ASSERT_EQ(report["meshes"].size(), 2u);
  EXPECT_EQ(report["meshes"][1]["name"], "b/bar.vtu");
  EXPECT_NE(report["meshes"][0]["name"], "bar.vtu") << "both have that name";
  const Json& meshes = report["meshes"];
  const std::size_t worst = meshes[0]["max_aspect_ratio"] > meshes[1]["max_aspect_ratio"] ? 0 : 1;
  EXPECT_EQ(report["worst_to_best"][0], meshes[worst]["name"]);
  EXPECT_NE(result.out.find("mesh, worst first"), std::string::npos) << result.out;
  EXPECT_EQ(countElements(folder_ / "out" / "stretch.svg", "polyline"), 12);
  EXPECT_TRUE(fs::exists(folder_ / "out" / report["meshes"][1]["series"].get<std::string>()));
}

TEST_F(SimulateCommand, TheFilesAreTheSameForAnyNumberOfThreads) {
  for (const char* threads : {"1", "3"})
    ASSERT_EQ(
        run({"simulate", at("bar.vtu"), "--indent", "--frames", "2", "-o", at(threads), "--threads", threads})
            .exitCode,
        0);
  for (const char* name : {"indent.csv", "indent-001.vtu", "indent.svg"})
    EXPECT_EQ(readBytes(folder_ / "1" / name), readBytes(folder_ / "3" / name)) << name;
}

TEST_F(SimulateCommand, ALooseSpeckIsHeldStill) {
  TissueMesh mesh = bar();
  const auto first = static_cast<std::int32_t>(mesh.mesh.nodes.size());
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0, 0, 0), {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}})
    mesh.mesh.nodes.push_back(x + Eigen::Vector3d(6, 0, 6));
  mesh.mesh.tets.push_back({first, first + 1, first + 2, first + 3});
  mesh.mesh.labels.push_back(1);
  writeMesh(mesh, folder_ / "speck.vtu");
  const ProgramResult result =
      run({"simulate", at("speck.vtu"), "--contract", "--tendon", "0.2", "--frames", "2", "-o", at("out")});
  EXPECT_EQ(result.exitCode, 0) << result.err;
}

TEST_F(SimulateCommand, ATrialThatStopsEarlyFailsAndIsWritten) {
  fs::create_directory(folder_ / "out");
  writeBytes(folder_ / "out" / "indent-002.vtu", "of an older run");
  const ProgramResult result =
      run({"simulate", at("bar.vtu"), "--indent", "0.99", "--frames", "2", "-o", at("out"), "--force"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(result.out.starts_with("bar.vtu: indentation stops at ")) << result.out;
  EXPECT_EQ(namesIn(folder_ / "out"),
            (std::vector<std::string>{"indent-000.vtu", "indent.csv", "indent.pvd", "indent.svg",
                                      "report.json"}));
  const Json report = Json::parse(readBytes(folder_ / "out" / "report.json"));
  EXPECT_FALSE(report["meshes"][0]["completed"]);
  EXPECT_EQ(countElements(folder_ / "out" / "indent.svg", "path"), 6) << "crosses where it stops";
}

TEST_F(SimulateCommand, AShorterRunRemovesTheFramesOfALongerOne) {
  const auto compress = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", at("bar.vtu"), "--compress", "0.1", "-o", at("out"), "--force"});
    EXPECT_EQ(run(more).exitCode, 0);
    return namesIn(folder_ / "out");
  };
  compress({"--frames", "4"});
  for (const char* other : {"compress-1.vtu", "compress-00x.vtu", "stretch-004.vtu"})
    writeBytes(folder_ / "out" / other, "not of this trial");
  const std::vector<std::string> kept{"compress-00x.vtu", "compress-1.vtu", "compress.csv",
                                      "compress.svg",     "report.json",    "stretch-004.vtu"};
  std::vector<std::string> series{"compress-000.vtu", "compress-001.vtu", "compress-002.vtu", "compress.pvd"};
  series.insert(series.end(), kept.begin(), kept.end());
  std::ranges::sort(series);
  EXPECT_EQ(compress({"--frames", "2"}), series);
  EXPECT_EQ(compress({"--frames", "2", "--no-series"}), kept);
}

TEST_F(SimulateCommand, TwistsEitherWay) {
  ASSERT_EQ(
      run({"simulate", at("bar.vtu"), "--twist", "-20", "--frames", "2", "--no-series", "-o", at("out")})
          .exitCode,
      0);
  EXPECT_EQ(Json::parse(readBytes(folder_ / "out" / "report.json"))["options"]["amount"], -20);
}

TEST_F(SimulateCommand, InvertedTetsAreNamedBeforeFibresAreMade) {
  TissueMesh mesh = bar();
  std::swap(mesh.mesh.tets[5][0], mesh.mesh.tets[5][1]);
  writeMesh(mesh, folder_ / "inverted.vtk");
  const std::string wrong =
      at("inverted.vtk") + ": 1 tets are flat or inverted at rest, the first is tet 5 near (";
  EXPECT_TRUE(failure({"simulate", at("inverted.vtk"), "--contract", "-o", at("out")}, 1).starts_with(wrong));
  EXPECT_TRUE(failure({"fibres", at("inverted.vtk"), "-o", at("o.vtu")}, 1).starts_with(wrong));
}

TEST_F(SimulateCommand, AnInterruptLeavesNothing) {
  Program program({"simulate", at("bar.vtu"), "--contract", "--tendon", "0.2", "--frames", "2000", "-o",
                   at("out"), "--verbose"});
  ASSERT_TRUE(program.waitFor("bar.vtu: contract"));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().exitCode, 130);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(SimulateCommand, ErrorsSayWhatAndWhere) {
  const auto refusal = [&](std::vector<std::string> arguments, int exitCode) {
    arguments.insert(arguments.begin(), "simulate");
    arguments.insert(arguments.end(), {"-o", at("out")});
    return failure(arguments, exitCode);
  };
  const std::string choose = "choose one of --contract, --compress, --indent, --stretch and --twist";
  EXPECT_EQ(refusal({at("bar.vtu")}, 2), choose);
  EXPECT_EQ(refusal({at("bar.vtu"), "--twist", "--contract"}, 2), choose);
  EXPECT_EQ(refusal({"--twist", "0", at("bar.vtu")}, 2),
            "--twist: the amount is 0, but must be an angle in degrees other than 0");
  EXPECT_EQ(refusal({"--twist", at("bar.vtu"), at("b.vtu")}, 2),
            "MESH: 2 meshes; add --compare to compare them");
  EXPECT_EQ(refusal({"--twist"}, 2), "MESH is required");
  EXPECT_EQ(refusal({at("bar.vtu"), "--twist", "--frames", "100000"}, 2),
            "--frames: 100000; it must be an even number up to 9998");
  EXPECT_EQ(refusal({at("none.vtu"), "--twist", "--frames", "41"}, 2),
            "--frames: 41; it must be an even number up to 9998");
  EXPECT_EQ(refusal({at("bar.vtu"), at("b.vtu"), "--twist"}, 2),
            "MESH: 2 meshes; add --compare to compare them");
  EXPECT_EQ(refusal({at("bar.vtu"), at("bar.vtu"), "--compare", "--twist"}, 2),
            "MESH: " + at("bar.vtu") + " is given twice");
  EXPECT_EQ(refusal({at("none.vtu"), "--twist", "--ends", "0"}, 2),
            "--ends: a share of 0; it must be above 0 and below 0.5");
  EXPECT_EQ(refusal({at("none.vtu"), "--compress", "1.2"}, 2),
            "--compress: the amount is 1.2, but must be a share in (0, 1)");
  EXPECT_EQ(refusal({at("none.vtu"), "--contract", "1.5"}, 2),
            "--contract: the amount is 1.5, but must be an activation in (0, 1]");
  for (const char* tendon : {"-1", "nan", "0.5"})
    EXPECT_EQ(refusal({at("none.vtu"), "--contract", std::string("--tendon=") + tendon}, 2),
              std::string("--tendon: a share of ") + tendon + "; it must be 0 or more and below 0.5");
  EXPECT_EQ(refusal({at("bar.vtu"), "--compress", "--spline", at("none.json")}, 2),
            "--spline: has no effect on --compress");
  EXPECT_EQ(refusal({at("bar.vtu"), "--twist", "--tendon", "0.1"}, 2), "--tendon: has no effect on --twist");
  EXPECT_EQ(refusal({at("bar.vtu"), "--indent", "--tension", "3"}, 2),
            "--tension: has no effect on --indent");
  EXPECT_FALSE(fs::exists(folder_ / "out"));

  writeBytes(folder_ / "twist.csv", "older");
  EXPECT_EQ(failure({"simulate", at("bar.vtu"), "--twist", "-o", folder_.path().string()}, 1),
            at("twist.csv") + ": exists; choose another output or give --force");
}

}  // namespace
}  // namespace sinew::test
