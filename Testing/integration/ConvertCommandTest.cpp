#include "Program.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/TissueCentroid.h"
#include "sinew/Segmentation/WriteSegmentation.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <map>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Tilted, anisotropic and off the origin, with several tissues.
fs::path makeTilted(const TempFolder& folder) {
  return makePhantom(folder, "upper-arm", {"--spacing", "1.5,2,3", "--tilt-deg", "20"});
}

void convert(const fs::path& in, const fs::path& out, const std::vector<std::string>& further = {}) {
  std::vector<std::string> arguments{"convert", in.string(), out.string(), "--quiet"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  const ProgramResult result = run(arguments);
  ASSERT_EQ(result.exitCode, 0) << result.err;
}

/// @param tolerance  of places, mm
/// @param colours    of parts of colours
void expectSame(const Segmentation& a, const Segmentation& b, double tolerance, double colours) {
  EXPECT_EQ(a.layers, b.layers);
  const Eigen::Affine3d placeOfA = a.geometry.indexToPhysical(), placeOfB = b.geometry.indexToPhysical();
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(a.geometry.size.cast<double>())})
    EXPECT_LT((placeOfA * corner - placeOfB * corner).norm(), tolerance);
  ASSERT_EQ(a.tissues.size(), b.tissues.size());
  for (std::size_t t = 0; t < a.tissues.size(); ++t) {
    EXPECT_EQ(a.tissues[t].name, b.tissues[t].name);
    EXPECT_EQ(a.tissues[t].label, b.tissues[t].label);
    EXPECT_EQ(a.tissues[t].voxels, b.tissues[t].voxels);
    for (int part = 0; part < 3; ++part)
      EXPECT_NEAR(a.tissues[t].color[part], b.tissues[t].color[part], colours);
  }
}

TEST(ConvertCommand, SegmentationsComeBackFromEveryFormat) {
  const TempFolder folder;
  const fs::path arm = makeTilted(folder);
  const Segmentation original = readSegmentation(arm);
  for (const char* name : {"a.seg.nrrd", "a.nrrd", "a.nii", "a.nii.gz", "a.mha"}) {
    SCOPED_TRACE(name);
    convert(arm, folder / name);
    ReadSegmentationOptions options;
    const bool plain = std::string_view(name) != "a.seg.nrrd";
    EXPECT_EQ(fs::exists(folder / "a.ctbl"), plain) << "names do not fit into a plain label map";
    if (plain) options.lut = folder / "a.ctbl";
    // NIfTI holds the geometry in single precision: 24 bits of up to 300 mm. Tables hold colours in bytes.
    const bool nifti = std::string_view(name).find(".nii") != std::string_view::npos;
    expectSame(readSegmentation(folder / name, options), original, nifti ? 1e-4 : 1e-6,
               plain ? 0.5 / 255 + 1e-9 : 1e-6);

    convert(folder / name, folder / "back.seg.nrrd",
            plain ? std::vector<std::string>{"--force", "--lut", (folder / "a.ctbl").string()}
                  : std::vector<std::string>{"--force"});
    expectSame(readSegmentation(folder / "back.seg.nrrd"), original, nifti ? 1e-4 : 1e-6,
               plain ? 0.5 / 255 + 1e-9 : 1e-6);
    if (plain) fs::remove(folder / "a.ctbl");
  }
}

TEST(ConvertCommand, TablesAreWrittenWhereTheyAreAskedFor) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  convert(nested, folder / "sub-01_dseg.nii.gz");
  EXPECT_TRUE(fs::exists(folder / "sub-01_dseg.tsv")) << "BIDS";
  convert(nested, folder / "a.nrrd", {"--no-table"});
  EXPECT_FALSE(fs::exists(folder / "a.ctbl"));
  convert(nested, folder / "b.seg.nrrd",
          {"--table", (folder / "b.csv").string(), "--table", (folder / "b.tsv").string()});
  const Segmentation original = readSegmentation(nested);
  for (const char* table : {"sub-01_dseg.tsv", "b.csv", "b.tsv"})
    expectSame(readSegmentation(folder / "a.nrrd", {.lut = folder / table}), original, 1e-6,
               0.5 / 255 + 1e-9);
}

TEST(ConvertCommand, OnlyTheTissuesAskedForAreKept) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  convert(nested, folder / "core.seg.nrrd", {"--tissue", "core"});
  const Segmentation core = readSegmentation(folder / "core.seg.nrrd");
  ASSERT_EQ(core.tissues.size(), 1u);
  EXPECT_EQ(core.tissues[0].name, "core");
}

TEST(ConvertCommand, OverlapIsRefusedUnlessARuleSaysWhoKeepsTheVoxels) {
  const TempFolder folder;
  const fs::path muscles = makePhantom(folder, "overlapping-muscles");
  const Segmentation original = readSegmentation(muscles);
  ASSERT_EQ(original.layers.size(), 2u);
  const std::string out = (folder / "a.nii.gz").string();
  const ProgramResult refused = run({"convert", muscles.string(), out});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(refused.err)) << refused.err;
  EXPECT_NE(refused.err.find("--priority"), std::string::npos) << refused.err;
  EXPECT_EQ(namesIn(folder.path()).size(), 1u);

  const std::string first = original.tissues[0].name, second = original.tissues[1].name;
  const auto voxelsOf = [&](const std::vector<std::string>& rule, const std::string& name) {
    convert(muscles, out, rule);
    const Segmentation merged = readSegmentation(out, {.lut = folder / "a.ctbl"});
    const auto tissue = std::ranges::find(merged.tissues, name, &Tissue::name);
    return tissue == merged.tissues.end() ? -1 : tissue->voxels;
  };
  EXPECT_EQ(voxelsOf({"--overlap", "first"}, first), original.tissues[0].voxels);
  EXPECT_LT(voxelsOf({"--overlap", "first", "--force"}, second), original.tissues[1].voxels);
  EXPECT_EQ(voxelsOf({"--priority", second, "--force"}, second), original.tissues[1].voxels);
}

TEST(ConvertCommand, WhatCannotBeIsRefusedBeforeAnyWork) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  const std::string input = nested.string();
  const auto expectRefused = [&](const std::vector<std::string>& files, int exitCode, const char* what) {
    std::vector<std::string> arguments{"convert"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    const auto before = namesIn(folder.path());
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    EXPECT_EQ(namesIn(folder.path()), before);
  };
  expectRefused({input, (folder / "a.vtu").string()}, 2, "sinew mesh");
  expectRefused({input, (folder / "a.stl.gz").string()}, 2, "a.stl.gz");
  expectRefused({input, input, (folder / "a.mha").string()}, 2, "one by one");
  expectRefused({input, (folder / "a.mha").string(), "--table", (folder / "a.txt").string()}, 2, "a.txt");
  expectRefused({(folder / "none.nrrd").string(), (folder / "a.mha").string()}, 1, "none.nrrd");
  expectRefused({input, input}, 1, "--force");
  writeBytes(folder / "a.ctbl", "mine");
  expectRefused({input, (folder / "a.mha").string()}, 1, "a.ctbl");
  writeBytes(folder / "text.txt", "hello");
  expectRefused({(folder / "text.txt").string(), (folder / "a.mha").string()}, 1, "neither");
}

TEST(ConvertCommand, TheResultIsToldAsJson) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  const ProgramResult result = run({"convert", nested.string(), (folder / "a.mha").string(), "--json", "-"});
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["kind"], "segmentation");
  EXPECT_EQ(json["tissues"].size(), 4u);
  EXPECT_EQ(json["tables"][0], (folder / "a.ctbl").string());
}

/// Centroids by label.
std::map<std::int32_t, Eigen::Vector3d> centroidsOf(const TetMesh& mesh) {
  std::map<std::int32_t, std::pair<Eigen::Vector3d, double>> sums;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    const auto& x = mesh.nodes;
    const double volume = (x[b] - x[a]).cross(x[c] - x[a]).dot(x[d] - x[a]) / 6;
    EXPECT_GT(volume, 0) << "M5";
    auto& [sum, total] = sums.try_emplace(mesh.labels[t], Eigen::Vector3d::Zero(), 0).first->second;
    sum += volume * (x[a] + x[b] + x[c] + x[d]) / 4;
    total += volume;
  }
  std::map<std::int32_t, Eigen::Vector3d> centroids;
  for (const auto& [label, sum] : sums) centroids[label] = sum.first / sum.second;
  return centroids;
}

/// How far a place is from the centroid of a tissue's voxels, in voxels along the axis where it is farthest.
double voxelsFromCentroid(const Segmentation& segmentation, std::int32_t label,
                          const Eigen::Vector3d& place) {
  const auto tissue = std::ranges::find(segmentation.tissues, label, &Tissue::label);
  if (tissue == segmentation.tissues.end()) return std::numeric_limits<double>::infinity();
  const Eigen::Affine3d toIndex = segmentation.geometry.indexToPhysical().inverse();
  return (toIndex * place - toIndex * tissueCentroid(segmentation, *tissue)).cwiseAbs().maxCoeff();
}

TEST(ConvertCommand, M4_CentroidsOfTheTiltedPhantomAgreeInEveryMeshFormatInLpsAndRas) {
  const TempFolder folder;
  const fs::path arm = makeTilted(folder);
  const Segmentation segmentation = readSegmentation(arm);
  // Compact tissues: in long thin ones the level set moves volume from one end to the other.
  ASSERT_EQ(run({"mesh", arm.string(), "-o", (folder / "meshes").string(), "--edge-length", "4", "--tissue",
                 "triceps", "--tissue", "biceps", "--combined"})
                .exitCode,
            0);
  const fs::path combined = folder / "meshes" / "combined.vtu";
  const auto expectCentroids = [&](const fs::path& file) {
    SCOPED_TRACE(file.filename());
    const auto centroids = centroidsOf(readMesh(file).mesh);
    EXPECT_EQ(centroids.size(), 2u);
    for (const auto& [label, centroid] : centroids)
      EXPECT_LT(voxelsFromCentroid(segmentation, label, centroid), 0.1) << label;
  };
  expectCentroids(combined);
  for (const MeshFormat& format : meshFormats())
    for (const char* space : {"LPS", "RAS"}) {
      const fs::path out = folder / ("all" + std::string(space) + std::string(format.extension));
      convert(combined, out, {"--space", space});
      if (format.readable) expectCentroids(out);
    }
}

TEST(ConvertCommand, CentroidsOfTheTiltedPhantomAgreeInEveryFormatOfSegmentations) {
  const TempFolder folder;
  const fs::path arm = makeTilted(folder);
  const Segmentation original = readSegmentation(arm);
  for (const char* name : {"a.seg.nrrd", "a.nrrd", "a.nii", "a.nii.gz", "a.mha"}) {
    SCOPED_TRACE(name);
    convert(arm, folder / name, {"--no-table"});
    const Segmentation read = readSegmentation(folder / name);
    ASSERT_EQ(read.tissues.size(), original.tissues.size());
    for (const Tissue& tissue : read.tissues)
      EXPECT_LT(voxelsFromCentroid(original, tissue.label, tissueCentroid(read, tissue)), 1e-4)
          << "single precision in NIfTI";
  }
}

TEST(ConvertCommand, SeveralMeshesBecomeOneWithARegionEach) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  ASSERT_EQ(run({"mesh", nested.string(), "-o", (folder / "m").string(), "--edge-length", "5"}).exitCode, 0);
  const std::string core = (folder / "m" / "core.vtu").string(),
                    inner = (folder / "m" / "inner_shell.vtu").string();
  const fs::path out = folder / "both.vtu";
  const ProgramResult result = run({"convert", core, inner, out.string(), "--json", "-"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["kind"], "mesh");
  ASSERT_EQ(json["regions"].size(), 2u);
  EXPECT_EQ(json["regions"][1]["name"], "inner shell");
  EXPECT_EQ(readMesh(out).mesh.tets.size(),
            readMesh(core).mesh.tets.size() + readMesh(inner).mesh.tets.size());

  const fs::path plain = folder / "liver.vtk";
  convert(core, plain, {"--no-space-tag"});
  ASSERT_EQ(run({"convert", plain.string(), inner, out.string(), "--force"}).exitCode, 0);
  EXPECT_EQ(readMesh(out).regions[0].name, "liver") << "named by its file";

  ASSERT_EQ(run({"convert", core, core, out.string(), "--force"}).exitCode, 0);
  const TissueMesh twice = readMesh(out);
  ASSERT_EQ(twice.regions.size(), 2u);
  EXPECT_NE(twice.regions[0].label, twice.regions[1].label) << "one of them got a new one";
}

TEST(ConvertCommand, OptionsOfTheOtherKindAreWrongUsage) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "4"});
  ASSERT_EQ(run({"mesh", nested.string(), "-o", (folder / "m").string(), "--edge-length", "6"}).exitCode, 0);
  const std::string mesh = (folder / "m" / "core.vtu").string(), inp = (folder / "a.inp").string();
  const auto expectRefused = [](const std::vector<std::string>& arguments, const std::string& message) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_EQ(result.err, "sinew: " + message + "\n");
  };
  const std::vector<std::vector<std::string>> ofSegmentations{{"--lut", "/nonexistent"},
                                                              {"--tissue", "nosuch"},
                                                              {"--overlap", "first"},
                                                              {"--priority", "nosuch"},
                                                              {"--table", "a.csv"},
                                                              {"--fractional-threshold", "0.5"},
                                                              {"--no-table"}};
  for (std::vector<std::string> option : ofSegmentations) {
    option.insert(option.begin(), {"convert", mesh, inp});
    expectRefused(option, option[3] + ": is for segmentations, and the inputs are meshes");
  }
  const std::vector<std::vector<std::string>> ofMeshes{
      {"--for", "febio"}, {"--space", "RAS"}, {"--no-space-tag"}, {"--unit", "m"}, {"--quadratic"}};
  for (std::vector<std::string> option : ofMeshes) {
    option.insert(option.begin(), {"convert", nested.string(), (folder / "a.mha").string()});
    expectRefused(option, option[3] + ": is for meshes, and the inputs are segmentations");
  }
  expectRefused({"convert", mesh, (folder / "a.VTK").string(), "--quadratic"},
                "--quadratic: .vtk has no tets of ten nodes; .msh, .inp, .feb and .exo have them");
  expectRefused({"convert", mesh, (folder / "a").string(), "--for", "mfem", "--quadratic"},
                "--quadratic: .vtu has no tets of ten nodes; .msh, .inp, .feb and .exo have them");
  expectRefused({"convert", mesh, (folder / "a.vtu").string(), "--for", "slicer", "--unit", "m"},
                "--unit: m: --for slicer takes mm, the only unit that the program knows");
  EXPECT_EQ(namesIn(folder.path()), (std::vector<std::string>{"m", "nested.seg.nrrd"}));
}

TEST(ConvertCommand, ATissueThatTwoFilesHoldIsSaid) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "4"});
  ASSERT_EQ(run({"mesh", nested.string(), "-o", (folder / "m").string(), "--edge-length", "6", "--combined"})
                .exitCode,
            0);
  const std::string core = (folder / "m" / "core.vtu").string(),
                    shell = (folder / "m" / "inner_shell.vtu").string(),
                    all = (folder / "m" / "combined.vtu").string(), out = (folder / "a.vtu").string();
  std::string tets = std::to_string(readMesh(core).mesh.tets.size());
  ASSERT_EQ(tets.size(), 4u) << "for the comma";
  tets.insert(1, ",");
  const std::string both = all + " and " + core + " both hold 'core' with " + tets + " tets";
  EXPECT_EQ(run({"convert", all, core, out}).err, both + "; each is written twice\n");
  EXPECT_EQ(run({"convert", all, core, shell, out, "--force"}).err,
            both + ", and so it is with 1 other tissue; each is written twice\n");
  EXPECT_EQ(run({"convert", core, shell, out, "--force"}).err, "");
  EXPECT_EQ(run({"convert", all, core, out, "--force", "--quiet"}).err, "");
}

TEST(ConvertCommand, TissuesThatLoseEveryVoxelAreNamed) {
  const TempFolder folder;
  Segmentation covered = readSegmentation(makePhantom(folder, "nested", {"--spacing", "4"}));
  for (Tissue& tissue : covered.tissues) tissue.layer = 0;
  const std::string whole = covered.tissues[0].name, other = covered.tissues[1].name;
  // The first tissue once more on a layer of its own, under another name.
  std::vector<std::int32_t> copy = covered.layers[0];
  for (std::int32_t& voxel : copy) voxel = voxel == covered.tissues[0].label ? voxel : 0;
  covered.layers.push_back(copy);
  Tissue twin = covered.tissues[0];
  twin.name = twin.id = "twin";
  twin.layer = 1;
  covered.tissues.push_back(twin);
  const std::string input = (folder / "covered.seg.nrrd").string(), out = (folder / "a.mha").string();
  writeSegmentation(covered, input);

  const ProgramResult result = run({"convert", input, out, "--overlap", "first", "--json", "-", "--quiet"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["lost_tissues"], Json({"twin"}));
  EXPECT_EQ(json["tissues"].size(), covered.tissues.size() - 1);

  const ProgramResult told = run({"convert", input, out, "--priority", "twin", "--force"});
  EXPECT_EQ(told.err, out + ": no voxel is left of '" + whole +
                          "': others that overlap come first; write a .seg.nrrd, or change --priority\n");
  EXPECT_NE(told.out.find(out + ": 4 tissues"), std::string::npos) << told.out;
}

TEST(ConvertCommand, ANameThatStandsInTheFileStays) {
  const TempFolder folder;
  Segmentation segmentation = readSegmentation(makePhantom(folder, "sphere", {"--spacing", "4"}));
  segmentation.tissues[0].name = "Segment_" + std::to_string(segmentation.tissues[0].label);
  const std::string input = (folder / "named.seg.nrrd").string();
  writeSegmentation(segmentation, input);
  ASSERT_EQ(run({"mesh", input, "-o", (folder / "m").string()}).exitCode, 0);
  const std::string name = segmentation.tissues[0].name;
  fs::rename(folder / "m" / (name + ".vtu"), folder / "liver.vtu");
  for (const char* out : {"a.vtu", "a.msh"}) {
    convert(folder / "liver.vtu", folder / out);
    EXPECT_EQ(readMesh(folder / out).regions[0].name, name) << out;
  }
  convert(folder / "a.msh", folder / "b.vtu");
  EXPECT_EQ(readMesh(folder / "b.vtu").regions[0].name, name);
}

TEST(ConvertCommand, APresetChoosesTheFormatOfANameWithoutOne) {
  const TempFolder folder;
  const fs::path sphere = makePhantom(folder, "sphere", {"--spacing", "4"});
  ASSERT_EQ(run({"mesh", sphere.string(), "-o", (folder / "m").string()}).exitCode, 0);
  const std::string mesh = (folder / "m" / "sphere.vtu").string();
  const ProgramResult result =
      run({"convert", mesh, (folder / "out").string(), "--for", "febio", "--json", "-"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["output"], (folder / "out.feb").string());
  EXPECT_TRUE(fs::exists(folder / "out.feb"));
  EXPECT_EQ(run({"convert", mesh, (folder / "out").string()}).exitCode, 2);
}

}  // namespace
}  // namespace sinew::test
