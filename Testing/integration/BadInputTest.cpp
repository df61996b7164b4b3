#include "Program.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <functional>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;

/// A NRRD in text: 3-D unless the fields say otherwise.
std::string nrrd(const std::string& type, const std::string& fields, const std::string& values) {
  return "NRRD0004\ntype: " + type + "\n" + fields + "\nencoding: ascii\n\n" + values + "\n";
}

const std::string kCube =
    "dimension: 3\nsizes: 2 2 2\nspace: left-posterior-superior\nspace origin: (0,0,0)\n";
const std::string kUnitAxes = "space directions: (1,0,0) (0,1,0) (0,0,1)";

struct BadFile {
  std::string name;  ///< file name, and name of the test
  std::function<void(const fs::path& file)> make;
  std::vector<std::string> told;  ///< what the message must hold besides the file's name
};

std::function<void(const fs::path&)> bytes(const std::string& content) {
  return [content](const fs::path& file) { writeBytes(file, content); };
}

void truncatedPhantom(const fs::path& file) {
  run({"phantom", "sphere", "-o", file.string()});
  fs::resize_file(file, fs::file_size(file) / 2);
}

const std::vector<BadFile> kBadFiles{
    {"missing.nrrd", [](const fs::path&) {}, {}},
    {"text.nrrd", bytes("These are the voyages.\n"), {}},
    {"empty.nii.gz", bytes(""), {}},
    {"truncated.seg.nrrd", truncatedPhantom, {}},
    {"flat.nrrd", bytes(nrrd("uint8", "dimension: 2\nsizes: 2 2", "0 1 1 0")), {}},
    {"series.nrrd",
     bytes(nrrd("uint8", "dimension: 4\nsizes: 2 2 2 2", "0 1 1 0 0 1 1 0 0 1 1 0 0 1 1 0")),
     {}},
    {"colours.nrrd",
     bytes(nrrd("uint8",
                "dimension: 4\nsizes: 3 2 1 1\nkinds: RGB-color domain domain domain\nspace: "
                "left-posterior-superior\n"
                "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)",
                "1 2 3 4 5 6")),
     {}},
    {"fractions.nrrd", bytes(nrrd("float", kCube + kUnitAxes, "0 1 2 0.5 0 0 0 0")), {"0.5"}},
    {"nan-spacing.nrrd",
     bytes(nrrd("uint8", kCube + "space directions: (nan,0,0) (0,1,0) (0,0,1)", "0 1 1 0 0 1 1 0")),
     {}},
    {"zero-spacing.nrrd",
     bytes(nrrd("uint8", kCube + "space directions: (0,0,0) (0,1,0) (0,0,1)", "0 1 1 0 0 1 1 0")),
     {}},
    {"singular.nrrd",
     bytes(nrrd("uint8", kCube + "space directions: (1,0,0) (1,0,0) (0,0,1)", "0 1 1 0 0 1 1 0")),
     {}},
    {"nothing.nrrd", bytes(nrrd("uint8", kCube + kUnitAxes, "0 0 0 0 0 0 0 0")), {}},
};

class BadInput : public testing::TestWithParam<BadFile> {};

TEST_P(BadInput, IsToldInOneLineAndLeavesNothing) {
  const TempFolder folder;
  const fs::path file = folder / GetParam().name;
  GetParam().make(file);
  const ProgramResult result = run({"mesh", file.string(), "-o", (folder / "out").string()});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find(GetParam().name), std::string::npos) << result.err;
  for (const std::string& text : GetParam().told)
    EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

INSTANTIATE_TEST_SUITE_P(Files, BadInput, testing::ValuesIn(kBadFiles), [](const auto& info) {
  std::string name = info.param.name.substr(0, info.param.name.find('.'));
  std::erase(name, '-');
  return name;
});

/// Runs `sinew mesh` on a good phantom with further arguments that must be refused.
struct Refusal {
  TempFolder folder;
  fs::path phantom = makePhantom(folder, "sphere", {"--spacing", "4"});
  fs::path out = folder / "out";

  ProgramResult mesh(const std::vector<std::string>& further) const {
    std::vector<std::string> arguments{"mesh", phantom.string(), "-o", out.string()};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run(arguments);
  }
  void expect(const std::vector<std::string>& further, int exitCode, const std::string& told) const {
    const ProgramResult result = mesh(further);
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(told), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(out));
  }
};

TEST(BadRequest, UnknownTissuesGetTheNearestNames) {
  const Refusal refusal;
  refusal.expect({"--tissue", "spere"}, 1,
                 "sphere.seg.nrrd: no tissue 'spere'; the nearest names are 'sphere'");
  refusal.expect({"--size", "spere=2"}, 1, "the nearest names are 'sphere'");
}

TEST(BadRequest, EdgeLengthsMustBePositiveAndFitInMemory) {
  const Refusal refusal;
  refusal.expect({"--edge-length", "0"}, 1, "larger than 0");
  refusal.expect({"--edge-length", "-1vox"}, 1, "larger than 0");
  refusal.expect({"--edge-length", "0.0001"}, 1, "would take about ");
}

TEST(BadRequest, UsageHasItsOwnExitCode) {
  const Refusal refusal;
  refusal.expect({"--edge-length", "wide"}, 2, "'wide' is no length");
  refusal.expect({"--edge-lenght", "2"}, 2, "--edge-lenght");
  refusal.expect({"--method", "magic"}, 2, "optimization");
  refusal.expect({"--physics", "drag=1"}, 2, "no effect on the method optimization");
  refusal.expect({"--method", "springs", "--physics", "poisson=0.1"}, 2, "no effect on the method springs");
  refusal.expect({"--method", "fem", "--physics", "poisson=0.6"}, 2, "poisson must be in (-1, 0.5)");
  refusal.expect({"--threads", "0"}, 2, "--threads");
  refusal.expect({"--size", "sphere"}, 2, "TISSUE=LENGTH");
  refusal.expect({"--config", (refusal.folder / "missing.toml").string()}, 2, "missing.toml");
  for (const auto& arguments : {std::vector<std::string>{}, {"mash"}, {"mesh"}, {"quality"}}) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exitCode, 2) << result.err;
    EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
  }
}

TEST(BadRequest, UnwritableOutputsAreFoundBeforeTheInputIsRead) {
  // Nobody can make files in /proc; the input is missing, so that reading it first would say so.
  const ProgramResult folder = run({"mesh", "missing.nrrd", "-o", "/proc/sinew"});
  EXPECT_EQ(folder.exitCode, 1);
  EXPECT_NE(folder.err.find("/proc: the folder is not writable"), std::string::npos) << folder.err;
  const ProgramResult json = run({"mesh", "missing.nrrd", "-o", "out", "--json", "/proc/a.json"});
  EXPECT_EQ(json.exitCode, 1);
  EXPECT_NE(json.err.find("/proc: the folder is not writable"), std::string::npos) << json.err;
}

TEST(BadRequest, ExistingOutputsNeedForce) {
  const Refusal refusal;
  fs::create_directory(refusal.out);
  writeBytes(refusal.out / "sphere.vtu", "precious");
  const ProgramResult result = refusal.mesh({});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("sphere.vtu: exists"), std::string::npos) << result.err;
  EXPECT_EQ(readBytes(refusal.out / "sphere.vtu"), "precious");
  EXPECT_EQ(namesIn(refusal.out).size(), 1u);

  EXPECT_EQ(refusal.mesh({"--force"}).exitCode, 0);
  EXPECT_NE(readBytes(refusal.out / "sphere.vtu"), "precious");
}

}  // namespace
}  // namespace sinew::test
