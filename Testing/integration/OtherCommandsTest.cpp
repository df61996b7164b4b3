#include "Program.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST(Program, HelpAndVersionAreResults) {
  for (const auto& arguments : {std::vector<std::string>{"--help"},
                                {"--version"},
                                {"mesh", "--help"},
                                {"info", "-h"},
                                {"quality", "--help"},
                                {"fibres", "--help"},
                                {"simulate", "--help"},
                                {"phantom", "--help"},
                                {"repair", "--help"},
                                {"phantom", "--list"},
                                {"mesh", "--version"}}) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_FALSE(result.out.empty());
  }
}

TEST(Program, TheHelpShowsTheDefaults) {
  const std::string help = run({"mesh", "--help"}).out;
  for (const char* text :
       {"--edge-length LENGTH=2vox", "--curvature FLOAT=", "--smoothing HOW=light", "--config FILE"})
    EXPECT_NE(help.find(text), std::string::npos) << text;
}

TEST(InfoCommand, ShowsGeometryAndTissues) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "2,2,4"});
  const ProgramResult text = run({"info", nested.string()});
  ASSERT_EQ(text.exitCode, 0) << text.err;
  EXPECT_NE(text.out.find("2.0000 x 2.0000 x 4.0000 mm"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("16.00000 mm^3"), std::string::npos) << text.out;

  const Json json = Json::parse(run({"info", nested.string(), "--json", "-"}).out);
  EXPECT_EQ(json["spacing_mm"], (Json{2., 2., 4.}));
  ASSERT_GT(json["tissues"].size(), 1u);
  for (const Json& tissue : json["tissues"]) {
    EXPECT_EQ(tissue["pieces"], 1);
    EXPECT_DOUBLE_EQ(tissue["volume_mm3"], 16. * tissue["voxels"].get<int>());
    EXPECT_NE(text.out.find(tissue["name"].get<std::string>()), std::string::npos);
  }
}

TEST(QualityCommand, MeasuresMeshesAndComparesThemWithTheirTissue) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "2"});
  ASSERT_EQ(run({"mesh", sphere.string(), "-o", (folder / "out").string(), "--edge-length", "5"}).exitCode,
            0);
  const std::string mesh = (folder / "out" / "sphere.vtu").string();
  const Json report = Json::parse(readBytes(folder / "out" / "report.json"))["tissues"][0];

  const Json plain = Json::parse(run({"quality", mesh, "--json", "-"}).out)["meshes"][0];
  EXPECT_EQ(plain["tets"], report["tets"]);
  EXPECT_EQ(plain["quality"], report["quality"]);
  EXPECT_EQ(plain["conditions"], report["conditions"]);
  EXPECT_FALSE(plain.contains("fidelity"));

  const ProgramResult compared = run({"quality", mesh, mesh, "--reference", sphere.string()});
  ASSERT_EQ(compared.exitCode, 0) << compared.err;
  EXPECT_NE(compared.out.find("Dice"), std::string::npos);
  const Json json = Json::parse(
      run({"quality", mesh, "--reference", sphere.string(), "--label", "1", "--json", "-"}).out)["meshes"][0];
  EXPECT_EQ(json["tissue"], "sphere");
  EXPECT_EQ(json["fidelity"]["dice"], report["fidelity"]["dice"]);
}

TEST(QualityCommand, ShowsHowTheQualityIsSpread) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "4"});
  ASSERT_EQ(run({"mesh", sphere.string(), "-o", (folder / "out").string()}).exitCode, 0);
  const std::string mesh = (folder / "out" / "sphere.vtu").string();
  const Json json = Json::parse(run({"quality", mesh, "--json", "-"}).out)["meshes"][0];
  const auto sum = [](const Json& histogram) {
    std::int64_t total = 0;
    for (const Json& count : histogram["counts"]) total += count.get<std::int64_t>();
    return total;
  };
  EXPECT_EQ(sum(json["histogram"]["dihedral_deg"]), 6 * json["tets"].get<std::int64_t>());
  EXPECT_EQ(sum(json["histogram"]["aspect_ratio"]), json["tets"].get<std::int64_t>());
  EXPECT_EQ(json["worst"].size(), 15u);

  const std::string chart = "60 - 70";
  EXPECT_NE(run({"quality", mesh}).out.find(chart), std::string::npos) << "by default for one mesh";
  EXPECT_EQ(run({"quality", mesh, mesh}).out.find(chart), std::string::npos);
  EXPECT_NE(run({"quality", mesh, mesh, "--histogram"}).out.find(chart), std::string::npos);
}

TEST(QualityCommand, ABrokenMeshIsToldInOneLine) {
  const TempFolder folder;
  writeBytes(folder / "broken.vtu", "<VTKFile");
  for (const char* name : {"broken.vtu", "missing.vtu"}) {
    const ProgramResult result = run({"quality", (folder / name).string()});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
  }
}

TEST(PhantomCommand, WritesTheSameFileAgain) {
  const TempFolder folder;
  const fs::path file = makePhantom(folder, "thin", {"--noise", "0.1", "--seed", "4"});
  const std::string bytes = readBytes(file);
  EXPECT_EQ(run({"phantom", "thin", "-o", file.string()}).exitCode, 1) << "it exists";
  EXPECT_EQ(
      run({"phantom", "thin", "-o", file.string(), "--noise", "0.1", "--seed", "4", "--force"}).exitCode, 0);
  EXPECT_EQ(readBytes(file), bytes);
  EXPECT_EQ(namesIn(folder.path()).size(), 1u);
}

TEST(PhantomCommand, UnknownNamesAreToldTheKnownOnes) {
  const TempFolder folder;
  const ProgramResult result = run({"phantom", "elbow", "-o", (folder / "a.nrrd").string()});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("upper-arm"), std::string::npos) << result.err;
  EXPECT_TRUE(namesIn(folder.path()).empty());
}

TEST(PhantomCommand, VoxelsTooLargeForTheTissuesAreRefused) {
  const TempFolder folder;
  const ProgramResult result =
      run({"phantom", "torus", "--spacing", "1000", "-o", (folder / "a.nrrd").string()});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("no voxel lies in a tissue; use a smaller --spacing"), std::string::npos)
      << result.err;
  EXPECT_TRUE(namesIn(folder.path()).empty());
}

}  // namespace
}  // namespace sinew::test
