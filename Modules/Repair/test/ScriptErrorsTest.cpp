#include "ScriptRunner.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

using test::errorOf;
using test::printed;
using Lines = std::vector<std::string>;

TEST(ScriptErrors, AnUnknownTissueIsToldTheNearest) {
  EXPECT_EQ(
      errorOf("local a = tissue 'humerus'\nlocal b = tissue 'bicep'"),
      "script.lua:2: arm.nrrd: no tissue 'bicep'; the nearest names are 'biceps', 'humerus', 'speckle'; "
      "`sinew info` lists all");
  EXPECT_EQ(
      errorOf("tissue 'hmerus*'"),
      "script.lua:1: tissue: none fits 'hmerus*'; the nearest names are 'humerus', 'biceps', 'speckle'");
  EXPECT_EQ(errorOf("tissue '*e*'"),
            "script.lua:1: tissue: '*e*' may be 'humerus' (label 1, layer 0), 'biceps' (label 2, layer 0), "
            "'speckle' "
            "(label 3, layer 0); use the id or the label");
  EXPECT_EQ(printed("print(tissue 'hum*')"), Lines{"tissue 'humerus'"});
  EXPECT_EQ(errorOf("tissue {}"), "script.lua:1: tissue: the name is a table; allowed: a text");
}

TEST(ScriptErrors, WrongTypesAndUnits) {
  EXPECT_EQ(
      errorOf("sphere{center={1, 2, 3}, radius='6cm'}"),
      "script.lua:1: sphere: radius is the text \"6cm\"; allowed: a length above 0, in mm, or a text like "
      "\"1.5mm\" or \"2vox\"");
  EXPECT_EQ(errorOf("sphere{center={1, 2, 3}, radius=-1}"),
            "script.lua:1: sphere: radius is -1; allowed: a length above 0, in mm, or a text like \"1.5mm\" "
            "or \"2vox\"");
  EXPECT_EQ(errorOf("sphere{center={1, 2}, radius=1}"),
            "script.lua:1: sphere: center is a table; allowed: three numbers {x, y, z} in mm");
  EXPECT_EQ(errorOf("sphere{center={1, 2, 'x'}, radius=1}"),
            "script.lua:1: sphere: number 3 of center is the text \"x\"; allowed: a number from "
            "-1000000 on, up to 1000000");
  EXPECT_EQ(errorOf("sphere{center={1, 2, 0/0}, radius=1}").find("number 3 of center is"), 22u);
  EXPECT_EQ(
      errorOf("local b = tissue 'biceps'\nb:offset 'thick'"),
      "script.lua:2: offset: the distance is the text \"thick\"; allowed: a length, in mm, or a text like "
      "\"1.5mm\" or \"2vox\"");
  EXPECT_EQ(
      errorOf("tissue('biceps'):drop_small '20mm'"),
      "script.lua:1: drop_small: the smallest volume is the text \"20mm\"; allowed: a volume from 0 on, in "
      "mm^3, or a text like \"20mm3\" or \"50vox\"");
  EXPECT_EQ(errorOf("local x = tissue 'biceps' + 5"),
            "script.lua:1: +: joins two shapes; its right side is 5");
  EXPECT_EQ(errorOf("local x = 5 - tissue 'biceps'"),
            "script.lua:1: -: joins two shapes; its left side is 5");
  EXPECT_EQ(errorOf("save('x', 5)"),
            "script.lua:1: save: the second argument is 5; allowed: a shape, like tissue \"biceps\" or "
            "sphere{...}");
  EXPECT_EQ(errorOf("volume()"), "script.lua:1: volume: the first argument is missing; usage: volume(shape)");
  EXPECT_EQ(errorOf("tissue('biceps'):keep_largest(1.5)"),
            "script.lua:1: keep_largest: the number of pieces is 1.5; allowed: a whole number from 1 on, up "
            "to 1000000000");
  EXPECT_EQ(
      errorOf("tissue('biceps'):smooth{time=1, preserve='size'}"),
      "script.lua:1: smooth: preserve is \"size\"; allowed: \"none\", \"volume\", \"topology\", \"both\"");
  EXPECT_EQ(errorOf("coordinates 'XYZ'"),
            "script.lua:1: coordinates: the system is \"XYZ\"; allowed: \"LPS\", \"RAS\"");
}

TEST(ScriptErrors, PlacesFarFromAnyBody) {
  EXPECT_EQ(errorOf("sphere{center={1, 2, 3e9}, radius=1}"),
            "script.lua:1: sphere: number 3 of center is 3000000000; allowed: a number from -1000000 on, up "
            "to 1000000");
  EXPECT_EQ(errorOf("sphere{center={1, 2, 3}, radius=1e30}"),
            "script.lua:1: sphere: radius is 1e+30, which is no size of a body");
}

TEST(ScriptErrors, MissingAndUnknownArguments) {
  EXPECT_EQ(errorOf("sphere{center={1, 2, 3}}"),
            "script.lua:1: sphere: radius is missing; usage: sphere{center={x, y, z}, radius=mm}");
  EXPECT_EQ(
      errorOf("sphere{centre={1, 2, 3}, radius=1}"),
      "script.lua:1: sphere: unknown argument 'centre'; the nearest is 'center'; usage: sphere{center={x, y, "
      "z}, radius=mm}");
  EXPECT_EQ(errorOf("sphere({1, 2, 3}, 4)"),
            "script.lua:1: sphere: too many arguments; usage: sphere{center={x, y, z}, radius=mm}");
  EXPECT_EQ(errorOf("sphere{{1, 2, 3}, 4}"),
            "script.lua:1: sphere: its arguments have names; usage: sphere{center={x, y, z}, radius=mm}");
  EXPECT_EQ(errorOf("tissue('biceps'):smooth{}"),
            "script.lua:1: smooth: time or sigma is missing; usage: shape:smooth{time=mm^2 or sigma=mm, "
            "preserve=\"none|volume|topology|both\"}");
  EXPECT_EQ(errorOf("union(tissue 'biceps')"),
            "script.lua:1: union: takes two shapes or more; usage: union(a, b, ..., {blend=mm})");
}

TEST(ScriptErrors, ShapesAreValues) {
  EXPECT_EQ(errorOf("local b = tissue 'biceps'\nb:ofset(1)"),
            "script.lua:2: a shape has no 'ofset'; the nearest are 'offset', 'name', 'bounds'");
  EXPECT_EQ(errorOf("local b = tissue 'biceps'\nb.name = 'x'"),
            "script.lua:2: a shape is a value and cannot be changed");
}

TEST(ScriptErrors, ImpossibleSolids) {
  EXPECT_EQ(errorOf("box{min={0, 0, 0}, max={1, -1, 1}}"),
            "script.lua:1: box: max has to lie above min along y, not 1 mm below");
  EXPECT_EQ(errorOf("coordinates 'RAS'\nbox{min={0, 0, 0}, max={1, -1, 1}}"),
            "script.lua:2: box: max has to lie above min along y, not 1 mm below");
  EXPECT_EQ(errorOf("capsule{from={1, 1, 1}, to={1, 1, 1}, radius=1}"),
            "script.lua:1: capsule: from and to are the same point");
  EXPECT_EQ(errorOf("torus{center={0, 0, 0}, axis={0, 0, 1}, radius=2, tube=2}"),
            "script.lua:1: torus: tube is not below radius");
  EXPECT_EQ(errorOf("halfspace{point={0, 0, 0}, normal={0, 0, 0}}"),
            "script.lua:1: halfspace: normal is {0, 0, 0}, no direction");
  EXPECT_EQ(errorOf("tube{points={{0, 0, 0}}, radius=1}"),
            "script.lua:1: tube: points is a table; allowed: a list of at least 2 points {{x, y, z}, ...}");
  EXPECT_EQ(errorOf("tube{points={{0, 0, 0}, {1, 1, 1}}, radius={1, 2, 3}}"),
            "script.lua:1: tube: radius has to be one length, or a list of 2, one for each point");
}

TEST(ScriptErrors, OnlySurfacesBelowTheScriptCanBeRead) {
  EXPECT_EQ(errorOf("mesh{file='/etc/passwd'}"),
            "script.lua:1: mesh: file is \"/etc/passwd\"; allowed: a surface, .stl, .ply, .obj or .vtp");
  EXPECT_EQ(errorOf("mesh{file='/tmp/a.stl'}"),
            "script.lua:1: mesh: file is \"/tmp/a.stl\"; allowed: a path from the script's folder downwards");
  EXPECT_EQ(
      errorOf("mesh{file='a/../../b.stl'}"),
      "script.lua:1: mesh: file is \"a/../../b.stl\"; allowed: a path from the script's folder downwards");
  const std::string error = errorOf("\nmesh{file='no.stl'}");
  EXPECT_TRUE(error.starts_with("script.lua:2: ")) << error;
  EXPECT_NE(error.find("no.stl"), error.npos) << error;
}

TEST(ScriptErrors, NamesToSave) {
  EXPECT_EQ(errorOf("save('', tissue 'biceps')"),
            "script.lua:1: save: the name is \"\"; allowed: a line of text");
  EXPECT_EQ(errorOf("save('x', tissue 'biceps', {color={0, 2, 0}})"),
            "script.lua:1: save: number 2 of color is 2; allowed: a number from 0 on, up to 1");
  EXPECT_EQ(
      errorOf("save('x', tissue 'biceps', {colour={0, 2, 0}})"),
      "script.lua:1: save: unknown argument 'colour'; the nearest is 'color'; usage: save(\"name\", shape, "
      "{color={red, green, blue}})");
}

TEST(ScriptErrors, Settings) {
  EXPECT_EQ(printed("print(radius, deep, where, setting('radius', 3), setting('other', 'none'))",
                    {.settings = {{"radius", "2.5"}, {"deep", "true"}, {"where", "left"}}, .check = true}),
            Lines{"2.5 true left 2.5 none"});
  EXPECT_EQ(errorOf("setting 'radius'"),
            "script.lua:1: setting: needs --set radius=VALUE, or a value to use without");
  EXPECT_EQ(errorOf("", {.settings = {{"tissue", "1"}}, .check = true}),
            "--set tissue: the name belongs to the script language");
  EXPECT_EQ(repairSegmentation(test::smallArm(), "", {.settings = {{"radios", "1"}}, .check = true}).messages,
            Lines{"--set radios: the script does not use it"});
}

}  // namespace
}  // namespace sinew
