#include "sinew/Segmentation/LabelTable.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

using Color = std::array<double, 3>;

LabelTable tableOf(const std::string& content, const std::string& name = "table.txt") {
  const test::TempFolder folder;
  test::writeBytes(folder / name, content);
  return readLabelTable(folder / name);
}

std::string errorOf(const std::string& content) {
  return test::messageOf<std::runtime_error>([&] { tableOf(content); });
}

TEST(LabelTable, SlicerTableTurnsUnderscoresToSpaces) {
  const LabelTable table = tableOf(
      "# Color table file C:/knee.ctbl\n# 99 values\n0 background 0 0 0 0\n"
      "12 vastus_lateralis_muscle 255 102 0 255\r\n13 _ 0 0 0 255\n");
  EXPECT_EQ(table.at(12).name, "vastus lateralis muscle");
  EXPECT_EQ(table.at(12).color, (Color{1, 0.4, 0}));
  EXPECT_EQ(table.at(13).name, "");
  EXPECT_EQ(table.size(), 3u);
}

TEST(LabelTable, SlicerTableIsToldByItsExtensionToo) {
  EXPECT_EQ(tableOf("1 left_kidney 1 2 3 255\n", "a.ctbl").at(1).name, "left kidney");
}

TEST(LabelTable, AlphaMayBeMissing) {
  EXPECT_EQ(tableOf("1 bone 255 0 51\n").at(1).color, (Color{1, 0, 0.2}));
}

TEST(LabelTable, FreeSurferKeepsItsNames) {
  const LabelTable table = tableOf(
      "#$Id: FreeSurferColorLUT.txt\n#No. Label Name:   R   G   B   A\n\n0   Unknown          0   0   0   0\n"
      "10  Left-Thalamus                           0   118 14  0\n1001    ctx_lh_bankssts   25  5   25  0\n");
  EXPECT_EQ(table.at(10).name, "Left-Thalamus");
  EXPECT_EQ(table.at(10).color, (Color{0, 118 / 255.0, 14 / 255.0}));
  EXPECT_EQ(table.at(1001).name, "ctx_lh_bankssts");
}

TEST(LabelTable, ItkSnap) {
  const LabelTable table = tableOf(
      "################################################\n# ITK-SnAP Label Description File\n"
      "    0     0    0    0        0  0  0    \"Clear Label\"\n"
      "    1   255    0    0        1  1  1    \"Left femur\"\n    2     0  255    0        0.5  1  1    \"a "
      "\"b\"\"\n");
  EXPECT_EQ(table.at(0).name, "Clear Label");
  EXPECT_EQ(table.at(1).name, "Left femur");
  EXPECT_EQ(table.at(1).color, (Color{1, 0, 0}));
  EXPECT_EQ(table.at(2).name, "a \"b\"");
}

TEST(LabelTable, SlicerCsvWithTermsAndQuotes) {
  const LabelTable table = tableOf(
      "LabelValue,Name,Color_R,Color_G,Color_B,Color_A,Category_CodingScheme\n"
      "1,left_kidney,185,102,83,255,SCT\n5,\"bone, \"\"long\"\"\",255,0,0,255,SCT\n");
  EXPECT_EQ(table.at(1).name, "left_kidney");
  EXPECT_EQ(table.at(1).color, (Color{185 / 255.0, 102 / 255.0, 83 / 255.0}));
  EXPECT_EQ(table.at(5).name, "bone, \"long\"");
}

TEST(LabelTable, TsvAndBidsTable) {
  EXPECT_EQ(tableOf("LabelValue\tName\tColor_R\tColor_G\tColor_B\tColor_A\n7\tfat pad\t0\t0\t255\t255\n")
                .at(7)
                .name,
            "fat pad");
  const LabelTable bids = tableOf("index\tname\tcolor\n3\tGray Matter\t#ff0033\n4\tWhite Matter\tn/a\n");
  EXPECT_EQ(bids.at(3).name, "Gray Matter");
  EXPECT_EQ(bids.at(3).color, (Color{1, 0, 0.2}));
  EXPECT_EQ(bids.at(4).color, (Color{0.5, 0.5, 0.5}));
}

TEST(LabelTable, MrtrixTables) {
  EXPECT_EQ(tableOf("0 Unknown\n1 Left-Cerebellum\n2 Vertebra 7\n").at(2).name, "Vertebra 7");
  const LabelTable table =
      tableOf("1 L.BSTS Left_bankssts 25 100 40 255\n2 L.CACG Left_cingulate 125 100 160 255\n");
  EXPECT_EQ(table.at(1).name, "Left_bankssts");
  EXPECT_EQ(table.at(2).color, (Color{125 / 255.0, 100 / 255.0, 160 / 255.0}));
}

TEST(LabelTable, NamesMayHoldSpacesAndNumbers) {
  const LabelTable table = tableOf("4 cervical vertebra 3 255 175 135 255\n-2 x 0 0 0 0\n");
  EXPECT_EQ(table.at(4).name, "cervical vertebra 3");
  EXPECT_EQ(table.at(-2).name, "x");
}

TEST(LabelTable, ByteOrderMarkAndLatin1BecomeUtf8) {
  EXPECT_EQ(tableOf("\xEF\xBB\xBF"
                    "1 Sch\xE4"
                    "del 0 0 0 255\n")
                .at(1)
                .name,
            "Sch\xC3\xA4"
            "del");
  EXPECT_EQ(tableOf("1 Sch\xC3\xA4"
                    "del 0 0 0 255\n")
                .at(1)
                .name,
            "Sch\xC3\xA4"
            "del");
}

TEST(LabelTable, WrongLineIsNamed) {
  const std::string message = errorOf("# comment\n1 bone 255 0 0 255\n2x fat 0 0 0 255\n");
  EXPECT_NE(message.find("table.txt: line 3 `2x fat 0 0 0 255`"), std::string::npos) << message;
  EXPECT_NE(errorOf("1 bone 255 0 256 255\n").find("line 1"), std::string::npos);
  EXPECT_NE(errorOf("1 bone 255 0 nan 255\n").find("line 1"), std::string::npos);
  EXPECT_NE(errorOf("99999999999 bone 255 0 0 255\n").find("line 1"), std::string::npos);
  EXPECT_NE(errorOf("LabelValue,Name\none,bone\n").find("line 2"), std::string::npos);
}

TEST(LabelTable, WhatIsNoTableIsRefused) {
  EXPECT_NE(errorOf("# nothing\n").find("holds no label"), std::string::npos);
  EXPECT_NE(errorOf(std::string("NRRD0004\0\1", 10)).find("is not a colour table"), std::string::npos);
  const test::TempFolder folder;
  const auto read = [&](const std::filesystem::path& file) {
    return test::messageOf<std::runtime_error>([&] { readLabelTable(file); });
  };
  EXPECT_NE(read(folder / "missing.ctbl").find("missing.ctbl: there is no such"), std::string::npos);
  EXPECT_NE(read(folder.path()).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace sinew
