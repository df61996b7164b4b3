// The contract between 3D Slicer and a module that is a program: what it asks, how it calls, what it takes
// for success.
#include "Program.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <thread>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const fs::path kModules = SINEW_MODULES;
const fs::path kMesherModule = kModules / "SinewMesher";
const fs::path kRepairModule = kModules / "SinewRepair";

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

ProgramResult runModule(const fs::path& module, const std::vector<std::string>& arguments) {
  return Program(module, arguments).wait();
}

/// A parameter as the description has it.
struct Parameter {
  std::string element, name, flag, index, standard, channel;
  std::vector<std::string> choices;
};

std::string childText(vtkXMLDataElement* element, const char* name) {
  vtkXMLDataElement* child = element->FindNestedElementWithName(name);
  return child == nullptr || child->GetCharacterData() == nullptr ? "" : child->GetCharacterData();
}

Parameter parameterOf(vtkXMLDataElement* element) {
  Parameter parameter{element->GetName(),
                      childText(element, "name"),
                      childText(element, "longflag"),
                      childText(element, "index"),
                      childText(element, "default"),
                      childText(element, "channel"),
                      {}};
  for (int n = 0; n < element->GetNumberOfNestedElements(); ++n)
    if (vtkXMLDataElement* child = element->GetNestedElement(n); std::string(child->GetName()) == "element")
      parameter.choices.emplace_back(child->GetCharacterData());
  return parameter;
}

std::vector<Parameter> parametersOf(const std::string& xml) {
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromString(xml.c_str(), VTK_ENCODING_UTF_8));
  std::vector<Parameter> parameters;
  if (root == nullptr || std::string(root->GetName()) != "executable") return parameters;
  for (int g = 0; g < root->GetNumberOfNestedElements(); ++g) {
    vtkXMLDataElement* group = root->GetNestedElement(g);
    if (std::string(group->GetName()) != "parameters") continue;
    for (int p = 0; p < group->GetNumberOfNestedElements(); ++p)
      if (vtkXMLDataElement* element = group->GetNestedElement(p);
          element->FindNestedElementWithName("name") != nullptr)
        parameters.push_back(parameterOf(element));
  }
  return parameters;
}

/// A value that a flag takes, as Slicer would give it.
std::vector<std::string> exampleOf(const Parameter& parameter) {
  static const std::map<std::string, std::string> kExamples{
      {"method", "hybrid"},     {"physics", "push=2,drag=1"}, {"set", "x=1,y=2"},
      {"size", "a=2mm,b=3vox"}, {"smooth", "a=none"},         {"tissue", "1,2"}};
  if (parameter.element == "boolean") return {};
  if (const auto example = kExamples.find(parameter.name); example != kExamples.end())
    return {example->second};
  return {parameter.standard.empty() ? "some.file" : parameter.standard};
}

class SlicerModule : public testing::TestWithParam<fs::path> {};
INSTANTIATE_TEST_SUITE_P(Modules, SlicerModule, testing::Values(kMesherModule, kRepairModule),
                         [](const auto& info) { return info.param.filename().string(); });

TEST_P(SlicerModule, C1_TheDescriptionComesAtOnceAndAlone) {
  const auto start = Clock::now();
  const ProgramResult result = runModule(GetParam(), {"--xml"});
  EXPECT_LT(secondsSince(start), 1) << "Slicer asks every program of the folder, and gives up after 5 s";
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(result.out.starts_with("<?xml")) << result.out.substr(0, 40);
  EXPECT_EQ(GetParam().extension(), "") << "Slicer passes over names with a dot";
}

TEST_P(SlicerModule, C1_NamesAndFlagsAreUniqueAndIndicesCount) {
  const std::vector<Parameter> parameters = parametersOf(runModule(GetParam(), {"--xml"}).out);
  ASSERT_GT(parameters.size(), 5u);
  std::set<std::string> names, flags;
  int index = 0;
  for (const Parameter& parameter : parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_TRUE(std::regex_match(parameter.name, std::regex("[A-Za-z][A-Za-z0-9]*"))) << parameter.name;
    EXPECT_TRUE(parameter.flag.empty() || flags.insert(parameter.flag).second) << parameter.flag;
    EXPECT_TRUE(parameter.index.empty() || parameter.index == std::to_string(index++)) << parameter.index;
    const bool result = parameter.channel == "output" && parameter.element == "integer";
    EXPECT_EQ(!parameter.flag.empty() + !parameter.index.empty(), result ? 0 : 1) << parameter.name;
  }
  EXPECT_GE(index, 2);
}

TEST_P(SlicerModule, C1_EveryFlagOfTheDescriptionIsTaken) {
  std::vector<std::string> arguments;
  std::vector<std::string> positional;
  for (const Parameter& parameter : parametersOf(runModule(GetParam(), {"--xml"}).out)) {
    if (!parameter.index.empty())
      positional.push_back(parameter.element == "geometry" ? "mesh.vtu" : "missing.nrrd");
    if (parameter.flag.empty()) continue;
    arguments.push_back("--" + parameter.flag);
    for (const std::string& value : exampleOf(parameter)) arguments.push_back(value);
  }
  arguments.insert(arguments.end(), positional.begin(), positional.end());
  const ProgramResult result = runModule(GetParam(), arguments);
  EXPECT_EQ(result.exitCode, 1) << "a missing input, not wrong usage: " << result.err;
  EXPECT_NE(result.err.find("there is no such"), std::string::npos) << result.err;
}

TEST(SlicerMesher, C1_EveryChoiceOfTheDescriptionIsTakenAndNoOther) {
  int choices = 0;
  for (const Parameter& parameter : parametersOf(runModule(kMesherModule, {"--xml"}).out))
    for (const std::string& choice : parameter.choices) {
      ++choices;
      const std::string flag = "--" + parameter.flag;
      EXPECT_EQ(runModule(kMesherModule, {flag, choice, "missing.nrrd", "a.vtu"}).exitCode, 1) << choice;
      EXPECT_EQ(runModule(kMesherModule, {flag, choice + "x", "missing.nrrd", "a.vtu"}).exitCode, 2)
          << choice;
    }
  EXPECT_GT(choices, 0);
}

TEST_P(SlicerModule, C1_EveryFlagThatIsTakenIsInTheDescription) {
  std::set<std::string> described{"xml",
                                  "returnparameterfile",
                                  "processinformationaddress",
                                  "echo",
                                  "logo",
                                  "serialize",
                                  "help",
                                  "deserialize",
                                  "version"};
  for (const Parameter& parameter : parametersOf(runModule(GetParam(), {"--xml"}).out))
    described.insert(parameter.flag);
  const std::string help = runModule(GetParam(), {"--help"}).out;
  const std::regex flag("\n  (?:-[a-z],)?--([a-z-]+)");
  int seen = 0;
  for (std::sregex_iterator found(help.begin(), help.end(), flag), end; found != end; ++found, ++seen)
    EXPECT_TRUE(described.contains((*found)[1])) << (*found)[1];
  EXPECT_GT(seen, 9);
}

/// What Slicer gives to any module, and may.
const std::vector<std::string> kContract{"--processinformationaddress", "0x7ffd1234", "--echo"};

std::vector<std::string> withContract(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = kContract;
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

TEST(SlicerMesher, C2_RunsAsSlicerCallsIt) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  const fs::path mesh = folder / "mesh.vtu", results = folder / "results.txt";
  const ProgramResult result = runModule(
      kMesherModule,
      withContract({"--edge-length", "6mm", "--curvature", "1", "--target-tets", "0", "--tissue",
                    "core,inner shell", "--size", "core=4mm", "--folder", (folder / "meshes").string(),
                    "--returnparameterfile", results.string(), nested.string(), mesh.string()}));
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const TissueMesh read = readMesh(mesh);
  ASSERT_EQ(read.regions.size(), 2u);
  EXPECT_EQ(namesIn(folder / "meshes"),
            (std::vector<std::string>{"core.vtu", "inner_shell.vtu", "scene.mrml"}));
  EXPECT_EQ(readBytes(results), "tissuesMeshed = 2\ntets = " + std::to_string(read.mesh.tets.size()) + "\n");
}

TEST(SlicerRepair, C2_RunsAsSlicerCallsIt) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  writeBytes(folder / "script.lua",
             "print(size)\nsave('core', tissue('core'):offset(size))\nremove 'inner shell'\n");
  const fs::path output = folder / "out.seg.nrrd", results = folder / "results.txt";
  const ProgramResult result =
      runModule(kRepairModule,
                withContract({"--set", "size=1", "--grid", "0mm", "--returnparameterfile", results.string(),
                              nested.string(), (folder / "script.lua").string(), output.string()}));
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(readSegmentation(output).tissues.size(), readSegmentation(nested).tissues.size() - 1);
  EXPECT_EQ(readBytes(results), "tissuesSaved = 1\ntissuesRemoved = 1\n");
  EXPECT_NE(result.out.find("\n1\n"), std::string::npos) << "what the script prints: " << result.out;
}

std::vector<double> progressIn(const std::string& text) {
  static const std::regex kMark("<filter-progress>([0-9.]+)</filter-progress>\n");
  std::vector<double> values;
  for (std::sregex_iterator found(text.begin(), text.end(), kMark), end; found != end; ++found)
    values.push_back(std::stod((*found)[1]));
  return values;
}

TEST(SlicerMesher, C3_ProgressGoesFromZeroToOneWithoutPausesAndNothingElseComplains) {
  const TempFolder folder;
  const fs::path arm = makePhantom(folder, "upper-arm");
  Program program(kMesherModule, {"--edge-length", "1.2mm", arm.string(), (folder / "mesh.vtu").string()});
  auto last = Clock::now();
  std::size_t seen = 0;
  double longest = 0;
  while (!program.ended()) {
    const std::size_t now = progressIn(program.output()).size();
    longest = std::max(longest, secondsSince(last));
    if (std::exchange(seen, now) != now) last = Clock::now();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_LT(longest, 2) << "what is not flushed does not move the bar";
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.err, "") << "Slicer takes any text there for an error";
  const std::vector<double> values = progressIn(result.out);
  ASSERT_GT(values.size(), 10u);
  EXPECT_EQ(values.front(), 0);
  EXPECT_EQ(values.back(), 1);
  EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
}

TEST(SlicerMesher, C2_NamesMayHoldCommas) {
  const TempFolder folder;
  Segmentation segmentation = readSegmentation(makePhantom(folder, "nested", {"--spacing", "3"}));
  segmentation.tissues[0].name = "Neoplasm, Primary";
  const std::string input = (folder / "commas.seg.nrrd").string(), mesh = (folder / "mesh.vtu").string();
  writeSegmentation(segmentation, input);
  const auto regionsOf = [&](const std::string& list) {
    const ProgramResult result =
        runModule(kMesherModule, {"--edge-length", "6", "--tissue", list, input, mesh});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    std::set<std::string> names;
    for (const TissueRegion& region : readMesh(mesh).regions) names.insert(region.name);
    return names;
  };
  EXPECT_EQ(regionsOf("Neoplasm, Primary"), std::set<std::string>{"Neoplasm, Primary"});
  EXPECT_EQ(regionsOf("inner shell, middle shell"), (std::set<std::string>{"inner shell", "middle shell"}));
}

TEST_P(SlicerModule, C1_ListsAreSaidToHaveCommas) {
  const std::string xml = runModule(GetParam(), {"--xml"}).out;
  EXPECT_EQ(xml.find("repeatable"), std::string::npos);
  EXPECT_NE(xml.find("; several with commas between</description>"), std::string::npos);
}

TEST(SlicerMesher, C4_AnUnknownKindOfMeshIsToldAtOnceByItsName) {
  const ProgramResult result = runModule(kMesherModule, {"missing.nrrd", "out/mesh.xyz"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(result.err,
            "SinewMesher: output-mesh: out/mesh.xyz: unknown kind of mesh file; known are .vtu, .vtk, "
            ".msh, .inp, .feb, .exo, .stl, .ply, .obj and .vtp\n");
}

TEST(SlicerMesher, C4_FailureIsOneLineAnExitCodeAndNoFile) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  const std::string mesh = (folder / "mesh.vtu").string(), meshes = (folder / "meshes").string();
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"--folder", meshes, (folder / "none.nrrd").string(), mesh},
           {"--folder", meshes, "--tissue", "unknown", nested.string(), mesh},
           {"--folder", meshes, "--edge-length", "-1", nested.string(), mesh},
           {"--folder", meshes, "--no-such-flag", "1", nested.string(), mesh},
           {"--folder", meshes, nested.string()},
           {"--folder", meshes, nested.string(), (folder / "none" / "mesh.vtu").string()}}) {
    const ProgramResult result = runModule(kMesherModule, arguments);
    EXPECT_GT(result.exitCode, 0);
    EXPECT_TRUE(result.err.starts_with("SinewMesher: ")) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"nested.seg.nrrd"}) << result.err;
  }
}

TEST(SlicerRepair, C4_FailureIsOneLineAnExitCodeAndNoFile) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3"});
  writeBytes(folder / "bad.lua", "print 'so far'\nsave('core', tissue 'nothing')\n");
  const ProgramResult result = runModule(
      kRepairModule, {nested.string(), (folder / "bad.lua").string(), (folder / "out.seg.nrrd").string()});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(result.err.starts_with("SinewRepair: ")) << result.err;
  EXPECT_NE(result.err.find("bad.lua:2"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(namesIn(folder.path()), (std::vector<std::string>{"bad.lua", "nested.seg.nrrd"}));
}

/// Names that do not begin with a dot.
std::vector<std::string> visibleNamesIn(const fs::path& folder) {
  std::vector<std::string> names = namesIn(folder);
  std::erase_if(names, [](const std::string& name) { return name.starts_with("."); });
  return names;
}

/// Slicer's Cancel kills the module.
TEST(SlicerMesher, C4_KilledAtAnyTimeItLeavesNothingUnderAFinalName) {
  const TempFolder source;
  const fs::path nested = makePhantom(source, "nested", {"--spacing", "2"});
  const auto call = [&](const TempFolder& folder) {
    return std::vector<std::string>{"--folder",      (folder / "meshes").string(),  "--edge-length", "3mm",
                                    nested.string(), (folder / "mesh.vtu").string()};
  };
  const std::vector<std::string> complete{"core.vtu", "inner_shell.vtu", "middle_shell.vtu",
                                          "outer_shell.vtu", "scene.mrml"};
  const auto start = Clock::now();
  const TempFolder whole;
  ASSERT_EQ(runModule(kMesherModule, call(whole)).exitCode, 0);
  const double seconds = secondsSince(start);
  ASSERT_EQ(namesIn(whole / "meshes"), complete);

  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 8; ++round) {
    const TempFolder folder;
    Program program(kMesherModule, call(folder));
    std::this_thread::sleep_for(
        std::chrono::duration<double>(std::uniform_real_distribution(0., seconds)(random)));
    program.signal(SIGKILL);
    if (program.wait().exitCode == 0) continue;  // it was faster
    for (const std::string& name : visibleNamesIn(folder / "meshes"))
      EXPECT_EQ(readBytes(folder / "meshes" / name), readBytes(whole / "meshes" / name));
    if (!fs::exists(folder / "mesh.vtu")) continue;
    EXPECT_EQ(readBytes(folder / "mesh.vtu"), readBytes(whole / "mesh.vtu"));
    EXPECT_EQ(visibleNamesIn(folder / "meshes"), complete) << "it comes last";
  }
}

std::set<std::string> regionNames(const fs::path& mesh) {
  std::set<std::string> names;
  for (const TissueRegion& region : readMesh(mesh).regions) names.insert(region.name);
  return names;
}

TEST(SlicerMesher, C5_ASegmentationUnderATemporaryNameGivesItsNames) {
  const TempFolder folder;
  const fs::path temporary = folder / "DBCD_vtkMRMLSegmentationNodeA.nrrd";
  fs::rename(makePhantom(folder, "nested", {"--spacing", "4"}), temporary);
  ASSERT_EQ(runModule(kMesherModule, {temporary.string(), (folder / "mesh.vtu").string()}).exitCode, 0);
  EXPECT_EQ(regionNames(folder / "mesh.vtu"),
            (std::set<std::string>{"core", "inner shell", "middle shell", "outer shell"}));
}

TEST(SlicerMesher, C5_ALabelMapWithItsColourTableGivesTheNames) {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "4"});
  const std::string map = (folder / "map.nrrd").string(), table = (folder / "colours.ctbl").string();
  ASSERT_EQ(run({"convert", nested.string(), map, "--table", table}).exitCode, 0);
  ASSERT_EQ(runModule(kMesherModule, {"--lut", table, map, (folder / "mesh.vtu").string()}).exitCode, 0);
  EXPECT_EQ(regionNames(folder / "mesh.vtu"),
            (std::set<std::string>{"core", "inner shell", "middle shell", "outer shell"}));
}

}  // namespace
}  // namespace sinew::test
