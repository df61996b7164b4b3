#include "SampleSegmentation.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

struct Written {
  std::string bytes;
  std::string header;
  Segmentation read;
};

Written writeAndRead(const Segmentation& segmentation) {
  const test::TempFolder folder;
  const auto file = folder / "a.seg.nrrd";
  writeSegmentation(segmentation, file);
  Written written{.bytes = test::readBytes(file), .header = {}, .read = readSegmentation(file)};
  written.header = written.bytes.substr(0, written.bytes.find("\n\n") + 1);
  return written;
}

TEST(WriteSegmentation, SmallestTypeThatHoldsTheLabels) {
  const auto typeOf = [](std::int32_t label) {
    Segmentation s = test::sampleSegmentation();
    s.layers[0][5] = label;
    s.tissues.clear();
    updateTissueTable(s);
    const Written written = writeAndRead(s);
    EXPECT_EQ(written.read.layers, s.layers) << label;
    const auto begin = written.header.find("type: ") + 6;
    return written.header.substr(begin, written.header.find('\n', begin) - begin);
  };
  EXPECT_EQ(typeOf(255), "unsigned char");
  EXPECT_EQ(typeOf(256), "short");
  EXPECT_EQ(typeOf(-1), "short");
  EXPECT_EQ(typeOf(32768), "unsigned short");
  EXPECT_EQ(typeOf(65536), "int");
  EXPECT_EQ(typeOf(-32769), "int");
  EXPECT_EQ(typeOf(INT32_MIN), "int");
}

TEST(WriteSegmentation, EqualIdsAreMadeUnique) {
  Segmentation s = test::sampleSegmentation();
  for (Tissue& tissue : s.tissues) tissue.id = "same";
  const Segmentation read = writeAndRead(s).read;
  EXPECT_EQ(read.tissues[0].id, "same");
  EXPECT_EQ(read.tissues[1].id, "same_2");
  EXPECT_EQ(read.tissues[2].id, "same_3");
}

TEST(WriteSegmentation, FaultsAreNamed) {
  const test::TempFolder folder;
  const auto file = folder / "no folder" / "a.seg.nrrd";
  EXPECT_NE(test::messageOf<std::runtime_error>([&] {
              writeSegmentation(test::sampleSegmentation(), file);
            }).find(file.string() + ": cannot be created"),
            std::string::npos);
  EXPECT_NE(test::messageOf<std::runtime_error>([] {
              writeSegmentation(test::sampleSegmentation(), "/dev/full");
            }).find("/dev/full: could not be written"),
            std::string::npos);
  Segmentation wrong = test::sampleSegmentation();
  wrong.layers[0].pop_back();
  EXPECT_THROW(writeSegmentation(wrong, folder / "a.seg.nrrd"), std::invalid_argument);
}

// What is written can be read again.
TEST(WriteSegmentation, RefusesMoreSegmentsThanItReads) {
  const test::TempFolder folder;
  Segmentation segmentation;
  segmentation.geometry.size = {4000, 1, 1};
  segmentation.layers.emplace_back(4000);
  for (std::int32_t label = 1; label <= 4000; ++label) segmentation.layers[0][label - 1] = label;
  updateTissueTable(segmentation);
  const std::string message =
      test::messageOf<std::runtime_error>([&] { writeSegmentation(segmentation, folder / "many.seg.nrrd"); });
  EXPECT_NE(message.find("key/value pairs for its 4000 segments"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(folder / "many.seg.nrrd"));
}

}  // namespace
}  // namespace sinew
