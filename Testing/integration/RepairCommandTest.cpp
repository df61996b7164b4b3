#include "Program.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// An upper arm of 4 mm voxels, and scripts beside it.
class RepairCommand : public testing::Test {
 protected:
  std::string script(const std::string& text, const std::string& name = "script.lua") {
    writeBytes(folder_ / name, text);
    return (folder_ / name).string();
  }
  std::string output(const std::string& name = "out.seg.nrrd") { return (folder_ / name).string(); }

  TempFolder folder_;
  std::string arm_ = makePhantom(folder_, "upper-arm", {"--spacing", "4"}).string();
};

const std::string kRepair =
    "local biceps  = tissue 'biceps'\n"
    "local humerus = tissue 'humerus'\n"
    "local c = centroid(biceps)\n"
    "biceps = biceps + capsule{from=c, to={c[1] + 20, c[2], c[3] + 30}, radius=setting('radius', 8), "
    "blend=2}\n"
    "biceps = (biceps - humerus:offset(0.5)):smooth{time=1.0, preserve='volume'}\n"
    "save('biceps', biceps)\n"
    "save('gap', box{min={0, 0, 0}, max={10, 20, 5}}:rotate{axis={0, 0, 1}, degrees=15}, {color={0.9, 0.5, "
    "0.4}})\n"
    "priority{'gap'}\n"
    "remove 'skin'\n"
    "print('done')\n";

TEST_F(RepairCommand, WritesASegmentationThatCanBeMeshed) {
  const ProgramResult result = run({"repair", arm_, script(kRepair), "-o", output(), "--set", "radius=10",
                                    "--json", (folder_ / "r.json").string(), "--vdb", output("vdb")});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(result.out.starts_with("done\n")) << result.out;
  EXPECT_NE(result.out.find("smooth"), std::string::npos) << result.out;
  EXPECT_EQ(namesIn(folder_ / "vdb"), (std::vector<std::string>{"biceps.vdb", "gap.vdb"}));

  const Json json = Json::parse(readBytes(folder_ / "r.json"));
  EXPECT_EQ(json["removed"], (Json{"skin"}));
  EXPECT_EQ(json["saved"][0]["name"], "biceps");
  EXPECT_GT(json["operations"].size(), 3u);
  EXPECT_EQ(json["operations"][0]["line"], 4);
  const Json info = Json::parse(run({"info", output(), "--json", "-"}).out);
  bool hasGap = false;
  for (const Json& tissue : info["tissues"]) {
    EXPECT_NE(tissue["name"], "skin");
    hasGap = hasGap || tissue["name"] == "gap";
  }
  EXPECT_TRUE(hasGap);
  EXPECT_EQ(run({"mesh", output(), "-o", output("mesh"), "--tissue", "biceps"}).exitCode, 0);
}

TEST_F(RepairCommand, CheckTriesAScriptWithoutAnOutput) {
  const ProgramResult good = run({"repair", "--check", script(kRepair), arm_});
  EXPECT_EQ(good.exitCode, 0) << good.err;
  EXPECT_NE(good.out.find("nothing wrong was found"), std::string::npos) << good.out;
  const ProgramResult bad = run({"repair", "--check", script("\nlocal b = tissue 'bicep'"), arm_});
  EXPECT_EQ(bad.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(bad.err)) << bad.err;
  EXPECT_NE(bad.err.find("script.lua:2: "), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find("no tissue 'bicep'; the nearest names are 'biceps'"), std::string::npos) << bad.err;
}

TEST_F(RepairCommand, AScriptThatFailsLeavesNothing) {
  const auto before = namesIn(folder_.path());
  const ProgramResult result = run(
      {"repair", arm_, script("save('biceps', tissue('biceps'):offset(1))\nio.open('x', 'w')", "script.lua"),
       "-o", output()});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_TRUE(isOneErrorLine(result.err)) << result.err;
  EXPECT_NE(result.err.find("script.lua:2: a repair script cannot open files (io)"), std::string::npos);
  EXPECT_FALSE(fs::exists(output()));
}

TEST_F(RepairCommand, OutputsAreCheckedFirst) {
  const std::string empty = script("");
  EXPECT_EQ(run({"repair", arm_, empty}).exitCode, 2) << "no output";
  EXPECT_EQ(run({"repair", arm_, empty, "-o", output("out.vtu")}).exitCode, 2);
  EXPECT_EQ(run({"repair", arm_, empty, "-o", output(), "--set", "radius"}).exitCode, 2);
  writeBytes(output(), "mine");
  const ProgramResult refused = run({"repair", arm_, empty, "-o", output()});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_EQ(readBytes(output()), "mine");
  EXPECT_EQ(run({"repair", arm_, empty, "-o", output(), "--force"}).exitCode, 0);
  EXPECT_EQ(run({"repair", arm_, "missing.lua", "-o", output("b.nrrd")}).err,
            "sinew: missing.lua: there is no such script\n");
}

TEST_F(RepairCommand, AnInterruptEndsAnEndlessLoop) {
  Program program(
      {"repair", arm_, script("local n = 0\nwhile true do n = n + 1 end"), "-o", output(), "--verbose"});
  ASSERT_TRUE(program.waitFor("line "));
  program.signal(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exitCode, 130) << result.err;
  EXPECT_FALSE(fs::exists(output()));
}

}  // namespace
}  // namespace sinew::test
