// Formats, presets, spaces and names of what `sinew mesh` writes, and what `sinew info` tells.
#include "Program.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <sstream>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Meshes a segmentation into `out` of the folder; the report.
Json meshed(const TempFolder& folder, const fs::path& input, const std::vector<std::string>& further) {
  std::vector<std::string> arguments{"mesh", input.string(), "-o", (folder / "out").string(), "--force"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  const ProgramResult result = run(arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return Json::parse(readBytes(folder / "out" / "report.json"));
}

TEST(MeshFiles, APresetChoosesFormatAndTagsAndASingleOptionBeatsIt) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "4"});
  const Json febio = meshed(folder, sphere, {"--for", "febio"});
  EXPECT_EQ(febio["tissues"][0]["file"], "sphere.feb");
  EXPECT_EQ(febio["scene"], "") << "3D Slicer does not read it";
  EXPECT_EQ(febio["options"]["space_tag"], false);

  const Json metres =
      meshed(folder, sphere, {"--for", "febio", "--format", "msh", "--unit", "m", "--combined"});
  EXPECT_EQ(metres["tissues"][0]["file"], "sphere.msh");
  EXPECT_EQ(metres["combined"], "combined.msh");
  EXPECT_EQ(metres["options"]["units_per_mm"], 0.001);

  const Json slicer = meshed(folder, sphere, {"--for", "slicer", "--space", "RAS"});
  EXPECT_EQ(slicer["scene"], "scene.mrml");
  EXPECT_NE(readBytes(folder / "out" / "scene.mrml").find("coordinateSystem=\"RAS\""), std::string::npos);
}

TEST(MeshFiles, WhatTheFormatOrTheProgramCannotHoldIsWrongUsage) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "4"});
  const auto expectRefused = [&](const std::vector<std::string>& options, const std::string& message) {
    std::vector<std::string> arguments{"mesh", sphere.string(), "-o", (folder / "out").string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_EQ(result.err, "sinew: " + message + "\n");
  };
  const auto straight = [](const std::string& extension) {
    return "--quadratic: " + extension + " has no tets of ten nodes; .msh, .inp, .feb and .exo have them";
  };
  expectRefused({"--quadratic"}, straight(".vtu"));
  for (const char* format : {".vtk", ".stl", ".ply", ".obj", ".vtp"})
    expectRefused({"--quadratic", "--format", format + 1}, straight(format));
  for (const char* program : {"slicer", "paraview", "mfem"})
    expectRefused({"--quadratic", "--for", program}, straight(".vtu"));
  expectRefused({"--quadratic", "--for", "sofa"}, straight(".vtk"));
  for (const char* unit : {"cm", "m"})
    expectRefused(
        {"--for", "slicer", "--unit", unit},
        "--unit: " + std::string(unit) + ": --for slicer takes mm, the only unit that the program knows");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(MeshFiles, TheMiddlesOfQuadraticTetsLieOnTheLevelSet) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "1"});
  meshed(folder, sphere, {"--edge-length", "8", "--for", "abaqus"});
  const std::string straight = readBytes(folder / "out" / "sphere.inp");
  meshed(folder, sphere, {"--edge-length", "8", "--for", "abaqus", "--quadratic"});
  const std::string curved = readBytes(folder / "out" / "sphere.inp");
  EXPECT_NE(straight.find("TYPE=C3D4"), std::string::npos);
  EXPECT_NE(curved.find("TYPE=C3D10"), std::string::npos);

  // Chords of 7 to 8 mm sag by 0.3 to 0.4 mm on a radius of 20 mm: what lies beyond 19.8 mm is at the
  // surface. The level set is within a fifth of a voxel of 1 mm.
  std::istringstream lines(curved.substr(curved.find("*NODE")));
  double farthest = 0;
  int beyond = 0;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line) && line[0] != '*';) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    double id = 0;
    Eigen::Vector3d node;
    numbers >> id >> node.x() >> node.y() >> node.z();
    farthest = std::max(farthest, node.norm());
    beyond += node.norm() > 19.8;
  }
  EXPECT_LT(farthest, 20.2);
  EXPECT_GT(beyond, 100);
}

TEST(MeshFiles, TissuesOfOneLabelOnTwoLayersStayApartInTheCombinedMesh) {
  const TempFolder folder;
  const fs::path muscles = makePhantom(folder, "overlapping-muscles");
  const Json report = meshed(folder, muscles, {"--edge-length", "6", "--combined"});
  std::set<int> labels;
  for (const Json& tissue : report["tissues"])
    EXPECT_TRUE(labels.insert(tissue["combined_label"].get<int>()).second);
  const TissueMesh mesh = readMesh(folder / "out" / "combined.vtu");
  ASSERT_EQ(mesh.regions.size(), report["tissues"].size());
  for (std::size_t t = 0; t < mesh.regions.size(); ++t) {
    EXPECT_EQ(mesh.regions[t].name, report["tissues"][t]["name"]);
    EXPECT_EQ(mesh.regions[t].label, report["tissues"][t]["combined_label"]);
  }
}

TEST(MeshFiles, M6_AwkwardNamesGiveDistinctFilesAndStayUnchangedInside) {
  const TempFolder folder;
  Segmentation segmentation = readSegmentation(makePhantom(folder, "nested", {"--spacing", "3"}));
  const std::vector<std::string> names{"a/b \"q\" <x>&y", "Übergröße", "combined", std::string(200, 'n')};
  for (std::size_t t = 0; t < names.size(); ++t) segmentation.tissues[t].name = names[t];
  writeSegmentation(segmentation, folder / "odd.seg.nrrd");
  const Json report = meshed(folder, folder / "odd.seg.nrrd", {"--edge-length", "6", "--combined"});
  std::set<std::string> files{report["combined"].get<std::string>()};
  EXPECT_NE(report["combined"], "combined.vtu") << "it is a tissue's";
  for (std::size_t t = 0; t < names.size(); ++t) {
    const Json& tissue = report["tissues"][t];
    EXPECT_EQ(tissue["name"], names[t]);
    EXPECT_EQ(tissue["id"], segmentation.tissues[t].id);
    EXPECT_TRUE(files.insert(tissue["file"].get<std::string>()).second);
    EXPECT_EQ(readMesh(folder / "out" / tissue["file"].get<std::string>()).regions[0].name, names[t]);
  }
}

TEST(InfoCommand, TellsPlacesTagsAndKeysOfASegmentation) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "2"});
  const Json json = Json::parse(run({"info", nested.string(), "--json", "-"}).out);
  const Json& core = json["tissues"][0];
  EXPECT_EQ(core["id"], readSegmentation(nested).tissues[0].id);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(core["centroid_mm"][axis].get<double>(), 0, 1e-9) << "the balls are about the origin";
    // Voxel centres at odd places below 8 mm: voxels from -8 to 8.
    EXPECT_NEAR(core["box_mm"]["upper"][axis].get<double>(), 8, 1e-9);
    EXPECT_EQ(core["box_voxels"]["upper"][axis].get<int>() - core["box_voxels"]["lower"][axis].get<int>(), 8);
  }
  EXPECT_TRUE(core["tags"].is_object());
  EXPECT_TRUE(json["keys"].is_object());
  EXPECT_TRUE(json["empty_tissues"].empty());
}

TEST(InfoCommand, DescribesMeshes) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "4"});
  const Json report = meshed(folder, sphere, {});
  const std::string mesh = (folder / "out" / "sphere.vtu").string();
  const Json json = Json::parse(run({"info", mesh, "--json", "-"}).out);
  EXPECT_EQ(json["tets"], report["tissues"][0]["tets"]);
  EXPECT_EQ(json["regions"][0]["name"], "sphere");
  EXPECT_NEAR(json["regions"][0]["volume_mm3"].get<double>(),
              report["tissues"][0]["fidelity"]["volume_mm3"].get<double>(), 1e-6);
  EXPECT_NE(run({"info", mesh}).out.find("sphere"), std::string::npos);
}

}  // namespace
}  // namespace sinew::test
