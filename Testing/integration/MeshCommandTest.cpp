#include "Program.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A nested phantom meshed coarsely, with further arguments.
ProgramResult meshNested(const TempFolder& folder, const std::vector<std::string>& further) {
  std::vector<std::string> arguments{
      "mesh", (folder / "nested.seg.nrrd").string(), "-o", (folder / "out").string(), "--edge-length", "4"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return run(arguments);
}

Json reportIn(const TempFolder& folder) { return Json::parse(readBytes(folder / "out" / "report.json")); }

TEST(MeshCommand, TheSphereHasItsVolumeAndGenus) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "1,1,2", "--tilt-deg", "20"});
  const ProgramResult result =
      run({"mesh", sphere.string(), "-o", (folder / "out").string(), "--edge-length", "3vox"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "") << "talk without a terminal";
  EXPECT_EQ(namesIn(folder / "out"), (std::vector<std::string>{"report.json", "scene.mrml", "sphere.vtu"}));
  const Json report = reportIn(folder);
  EXPECT_NEAR(report["options"]["edge_length_mm"], 3 * std::cbrt(2.), 1e-12);
  const Json& tissue = report["tissues"][0];
  EXPECT_EQ(tissue["status"], "meshed");
  EXPECT_EQ(tissue["topology"]["components"], 1);
  EXPECT_EQ(tissue["topology"]["euler_characteristic"], 2);
  // Chords of 3.8 mm on a radius of 20 mm lose about 0.5 % of the volume.
  const double ball = 4 * std::numbers::pi / 3 * 20 * 20 * 20;
  EXPECT_NEAR(tissue["fidelity"]["volume_mm3"].get<double>() / ball, 1, 0.015);
  EXPECT_GT(tissue["fidelity"]["dice"], 0.97);
  EXPECT_LT(tissue["quality"]["max_aspect_ratio"], 4.5);
}

TEST(MeshCommand, TheTorusKeepsItsHole) {
  const TempFolder folder;
  const fs::path torus = makePhantom(folder, "torus");
  ASSERT_EQ(run({"mesh", torus.string(), "-o", (folder / "out").string(), "--edge-length", "3"}).exitCode, 0);
  const Json topology = reportIn(folder)["tissues"][0]["topology"];
  EXPECT_EQ(topology["euler_characteristic"], 0);
  EXPECT_EQ(topology["level_set_euler_characteristic"], 0);
}

TEST(MeshCommand, ResultsGoToStdoutAndTalkToStderr) {
  const TempFolder folder;
  makePhantom(folder, "nested", {"--spacing", "2"});
  const ProgramResult verbose = meshNested(folder, {"--verbose"});
  ASSERT_EQ(verbose.exitCode, 0) << verbose.err;
  EXPECT_TRUE(verbose.out.starts_with("tissue ")) << verbose.out;
  EXPECT_NE(verbose.out.find(" meshed, 0 lost, 0 failed; "), std::string::npos) << verbose.out;
  EXPECT_NE(verbose.out.find("report: "), std::string::npos) << verbose.out;
  EXPECT_NE(verbose.err.find(": level set\n"), std::string::npos) << verbose.err;
  EXPECT_EQ(verbose.out.find('\033'), std::string::npos) << "colour without a terminal";

  const ProgramResult json = meshNested(folder, {"--force", "--quiet", "--json", "-"});
  ASSERT_EQ(json.exitCode, 0) << json.err;
  EXPECT_EQ(json.err, "");
  EXPECT_EQ(json.out, readBytes(folder / "out" / "report.json"));

  const fs::path copy = folder / "copy.json";
  ASSERT_EQ(meshNested(folder, {"--force", "--json", copy.string()}).exitCode, 0);
  EXPECT_EQ(readBytes(copy), readBytes(folder / "out" / "report.json"));
}

TEST(MeshCommand, TheSameFilesForAnyNumberOfThreads) {
  const TempFolder folder;
  makePhantom(folder, "nested", {"--spacing", "2"});
  std::vector<std::string> first;
  for (const char* threads : {"1", "2", "4"}) {
    ASSERT_EQ(meshNested(folder, {"--force", "--threads", threads}).exitCode, 0);
    EXPECT_EQ(reportIn(folder)["threads"], std::stoi(threads));
    std::vector<std::string> files;
    for (const std::string& name : namesIn(folder / "out"))
      if (name != "report.json") files.push_back(readBytes(folder / "out" / name));
    if (first.empty()) first = files;
    EXPECT_TRUE(files == first) << threads << " threads";
  }
}

TEST(MeshCommand, TissuesSizesAndConfigFile) {
  const TempFolder folder;
  makePhantom(folder, "nested", {"--spacing", "2"});
  writeBytes(folder / "options.toml", "tissue = [\"1\", \"2\"]\ncurvature = 0\nsize = \"1=2.5vox\"\n");
  ASSERT_EQ(meshNested(folder, {"--config", (folder / "options.toml").string()}).exitCode, 0);
  const Json report = reportIn(folder);
  EXPECT_EQ(report["options"]["curvature"], 0.0);
  ASSERT_EQ(report["tissues"].size(), 2u);
  EXPECT_EQ(report["tissues"][0]["edge_length_mm"], 5.0);
  EXPECT_EQ(report["tissues"][1]["edge_length_mm"], 4.0);
}

TEST(MeshCommand, QualityGoesIntoTheFilesAndTheWorstTetsIntoTheReport) {
  const TempFolder folder;
  makePhantom(folder, "nested", {"--spacing", "2"});
  ASSERT_EQ(meshNested(folder, {"--with-quality"}).exitCode, 0);
  const Json report = reportIn(folder);
  EXPECT_EQ(report["options"]["with_quality"], true);
  for (const Json& tissue : report["tissues"]) {
    const std::string file = readBytes(folder / "out" / tissue["file"].get<std::string>());
    for (const char* name : {"aspect_ratio", "min_dihedral_deg", "max_dihedral_deg", "phi"})
      EXPECT_NE(file.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
    ASSERT_EQ(tissue["worst"].size(), 15u);
    EXPECT_EQ(tissue["worst"][0]["measure"], "aspect_ratio");
    EXPECT_EQ(tissue["worst"][0]["value"], tissue["quality"]["max_aspect_ratio"]);
    EXPECT_EQ(tissue["worst"][5]["value"], tissue["quality"]["min_dihedral_deg"]);
    EXPECT_EQ(tissue["worst"][10]["value"], tissue["quality"]["max_dihedral_deg"]);
    EXPECT_EQ(tissue["worst"][0]["place_mm"].size(), 3u);
  }
}

TEST(MeshCommand, TheNumberOfTetsMayBeChosen) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "2"});
  const auto mesh = [&](const std::vector<std::string>& further) {
    std::vector<std::string> arguments{"mesh", sphere.string(), "-o", (folder / "out").string(), "--force"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run(arguments);
  };
  std::vector<std::string> files;
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(mesh({"--target-tets", "30000", "--threads", threads}).exitCode, 0);
    files.push_back(readBytes(folder / "out" / "sphere.vtu"));
  }
  EXPECT_TRUE(files[0] == files[1]) << "depends on the number of threads";
  const Json tissue = reportIn(folder)["tissues"][0];
  EXPECT_NEAR(tissue["tets"].get<double>(), 30'000, 3000);
  EXPECT_EQ(tissue["message"], "");
  EXPECT_EQ(mesh({"--target-tets", "30000", "--edge-length", "2"}).exitCode, 2) << "one or the other";
}

TEST(MeshCommand, ToleranceAndSmallestCubeDriveTheRefinement) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "1"});
  const auto tissueWith = [&](const std::vector<std::string>& further) {
    std::vector<std::string> arguments{"mesh",    sphere.string(), "-o", (folder / "out").string(),
                                       "--force", "--edge-length", "4",  "--curvature",
                                       "0"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    EXPECT_EQ(run(arguments).exitCode, 0);
    return reportIn(folder)["tissues"][0];
  };
  // On the radius of 20 mm the bound h^2 / (8 * 20 mm) is 0.1 mm for cubes of 4 mm; the terraces of the
  // voxels, which the smoothing leaves, come on top.
  const Json plain = tissueWith({}), fine = tissueWith({"--tolerance", "0.1"}),
             capped = tissueWith({"--tolerance", "0.1", "--min-edge-length", "4"});
  EXPECT_EQ(tissueWith({"--tolerance", "0.5"})["tets"], plain["tets"]);
  EXPECT_GT(fine["tets"], 3 * plain["tets"].get<int>());
  EXPECT_EQ(capped["tets"], plain["tets"]);
  EXPECT_LT(fine["fidelity"]["surface_max_mm"], 0.1);
  EXPECT_GT(plain["fidelity"]["surface_max_mm"], 0.1);
}

TEST(MeshCommand, TheVolumeMayBePreserved) {
  const TempFolder folder;
  const fs::path torus = makePhantom(folder, "torus");
  ASSERT_EQ(run({"mesh", torus.string(), "-o", (folder / "out").string(), "--edge-length", "4",
                 "--preserve-volume"})
                .exitCode,
            0);
  const Json fidelity = reportIn(folder)["tissues"][0]["fidelity"];
  EXPECT_NEAR(fidelity["volume_mm3"].get<double>() / fidelity["level_set_volume_mm3"].get<double>(), 1,
              0.001);
}

TEST(MeshCommand, MethodsWithPhysicsKeepTheirBoundsAndTheVolume) {
  const TempFolder folder;
  const fs::path torus = makePhantom(folder, "torus");
  for (const std::string method : {"springs", "fem", "hybrid"}) {
    SCOPED_TRACE(method);
    ASSERT_EQ(run({"mesh", torus.string(), "-o", (folder / "out").string(), "--edge-length", "4", "--force",
                   "--preserve-volume", "--method", method, "--physics", "drag=0.8"})
                  .exitCode,
              0);
    const Json report = reportIn(folder);
    EXPECT_EQ(report["options"]["method"], method);
    EXPECT_EQ(report["options"]["physics"]["drag"], 0.8);
    EXPECT_EQ(report["options"]["physics"].contains("poisson"), method != "springs");
    const Json& tissue = report["tissues"][0];
    EXPECT_GT(tissue["compression"]["physics"]["tets"], 0);
    EXPECT_GT(tissue["compression"]["physics"]["velocity_steps"], 0);
    EXPECT_LE(tissue["quality"]["max_aspect_ratio"], 5);
    EXPECT_GE(tissue["quality"]["min_dihedral_deg"], 17);
    EXPECT_LE(tissue["quality"]["max_dihedral_deg"], 147);
    EXPECT_LT(tissue["fidelity"]["max_boundary_phi_mm"], 1e-3 * 4);
    EXPECT_NEAR(tissue["fidelity"]["volume_mm3"].get<double>() /
                    tissue["fidelity"]["level_set_volume_mm3"].get<double>(),
                1, 0.001);
  }
}

TEST(MeshCommand, AnUnderResolvedTissueIsToldTheOptionToChange) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "4"});
  const auto outputWith = [&](const std::vector<std::string>& further) {
    std::vector<std::string> arguments{"mesh",    sphere.string(), "-o", (folder / "out").string(),
                                       "--force", "--edge-length", "30", "--curvature",
                                       "0"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run(arguments).out;
  };
  const std::string warned = outputWith({});
  const std::size_t start = warned.find("--size 'sphere=");
  ASSERT_NE(start, std::string::npos) << warned;
  EXPECT_NE(warned.find("sphere (meshed): under-resolved: volume "), std::string::npos) << warned;
  const std::string size = warned.substr(start + 8, warned.find('\'', start + 8) - start - 8);
  EXPECT_EQ(outputWith({"--size", size}).find("under-resolved"), std::string::npos) << size;
}

/// A Slicer segmentation of 14^3 voxels of 1 mm: a cube of 8^3 with label 1 and the given name, one voxel
/// with label 2.
fs::path cubeAndThread(const TempFolder& folder, const std::string& cubeName) {
  std::string text =
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 14 14 14\nspace: left-posterior-superior\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: ascii\n"
      "Segment0_ID:=a\nSegment0_Name:=" +
      cubeName +
      "\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
      "Segment1_ID:=b\nSegment1_Name:=thread\nSegment1_LabelValue:=2\nSegment1_Layer:=0\n\n";
  for (int z = 0; z < 14; ++z)
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 14; ++x)
        text += std::min({x, y, z}) > 2 && std::max({x, y, z}) < 11 ? "1 "
                : x > 1 && x < 12 && y == 1 && z == 1               ? "2 "
                                                                    : "0 ";
  writeBytes(folder / "cube.seg.nrrd", text + "\n");
  return folder / "cube.seg.nrrd";
}

TEST(MeshCommand, ATissueTooSmallForTheLatticeIsLostByName) {
  const TempFolder folder;
  const fs::path file = cubeAndThread(folder, "cube");
  const ProgramResult result =
      run({"mesh", file.string(), "-o", (folder / "out").string(), "--edge-length", "3", "--curvature", "0"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(namesIn(folder / "out"), (std::vector<std::string>{"cube.vtu", "report.json", "scene.mrml"}));
  const Json lost = reportIn(folder)["tissues"][1];
  EXPECT_EQ(lost["status"], "lost");
  EXPECT_EQ(lost["file"], "");
  EXPECT_EQ(lost["lost"]["components"], 1);
  EXPECT_EQ(lost["lost"]["volume_mm3"], 10.0);
  EXPECT_NE(result.out.find("thread (lost): too small for the lattice"), std::string::npos) << result.out;
}

TEST(MeshCommand, NothingButLostTissuesIsAFailure) {
  const TempFolder folder;
  const fs::path file = cubeAndThread(folder, "cube");
  const ProgramResult result = run({"mesh", file.string(), "-o", (folder / "out").string(), "--tissue",
                                    "thread", "--edge-length", "3", "--curvature", "0"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
}

TEST(MeshCommand, HostileNamesStayInTheFolder) {
  const TempFolder folder;
  const fs::path file = cubeAndThread(folder, "../../évil\033[2J name");
  const ProgramResult result =
      run({"mesh", file.string(), "-o", (folder / "out").string(), "--tissue", "1", "--edge-length", "3"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(namesIn(folder / "out"),
            (std::vector<std::string>{"_._.._évil_[2J_name.vtu", "report.json", "scene.mrml"}));
  EXPECT_EQ(result.out.find('\033'), std::string::npos) << "a name controls the terminal";
}

}  // namespace
}  // namespace sinew::test
