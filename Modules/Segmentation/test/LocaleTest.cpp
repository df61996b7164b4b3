#include "SampleSegmentation.h"
#include "sinew/Segmentation/WriteLabelMap.h"
#include "sinew/Segmentation/WriteLabelTable.h"
#include "sinew/TestSupport/CommaLocale.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

/// What is written and read depends on nobody's language.
namespace sinew {
namespace {

const std::vector<std::string> kImages{"a.seg.nrrd", "a.nrrd", "a.nii", "a.nii.gz", "a.mha", "a.mhd"};
const std::vector<std::string> kTables{"a.ctbl", "a.csv", "a.tsv"};

Segmentation awkward() {
  Segmentation s = test::sampleSegmentation();
  s.geometry.origin = {-1234567.5, 0.1, 1e-20};
  return s;
}

void writeAll(const std::filesystem::path& folder) {
  const Segmentation s = awkward();
  writeSegmentation(s, folder / kImages[0]);
  for (std::size_t n = 1; n < kImages.size(); ++n) writeLabelMap(s, folder / kImages[n]);
  for (const std::string& table : kTables) writeLabelTable(labelTable(s), folder / table);
}

TEST(Locale, CommaLocaleIsOne) {
  const test::CommaLocale german;
  std::ostringstream stream;
  stream << 1234.5;
  EXPECT_EQ(stream.str(), "1.234,5") << "else the tests below show nothing";
  if (!test::CommaLocale::inC())
    GTEST_SKIP() << "neither de_DE.UTF-8 nor localedef's data here (Debian: locales); only C++ was tried";
  char text[16];
  std::snprintf(text, sizeof text, "%g", 0.5);
  EXPECT_STREQ(text, "0,5");
}

TEST(Locale, SameBytesWhereADecimalPointIsAComma) {
  const test::TempFolder english, german;
  writeAll(english.path());
  {
    const test::CommaLocale comma;
    writeAll(german.path());
  }
  for (const auto* names : {&kImages, &kTables})
    for (const std::string& name : *names)
      EXPECT_EQ(test::readBytes(german / name), test::readBytes(english / name)) << name;
}

TEST(Locale, SameGeometryWhereADecimalPointIsAComma) {
  const test::TempFolder folder;
  writeAll(folder.path());
  std::vector<ImageGeometry> expected;
  for (const std::string& name : kImages) expected.push_back(readSegmentation(folder / name).geometry);
  const test::CommaLocale comma;
  for (std::size_t n = 0; n < kImages.size(); ++n) {
    const ImageGeometry read = readSegmentation(folder / kImages[n]).geometry;
    EXPECT_EQ(read.indexToPhysical().matrix(), expected[n].indexToPhysical().matrix()) << kImages[n];
  }
  for (const std::string& table : kTables)
    EXPECT_EQ(readLabelTable(folder / table).at(1).color, (std::array<double, 3>{85 / 255.0, 26 / 255.0, 1}));
}

}  // namespace
}  // namespace sinew
