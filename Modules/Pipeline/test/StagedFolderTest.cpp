#include "sinew/Pipeline/StagedFolder.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

using test::readBytes;
using test::TempFolder;
using test::writeBytes;

std::ptrdiff_t entriesOf(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(StagedFolder, FilesAppearTogetherAndReplaceOlderOnes) {
  const TempFolder folder;
  writeBytes(folder / "a", "old");
  writeBytes(folder / "other", "stays");
  {
    StagedFolder staged(folder.path());
    writeBytes(staged.temporary() / "a", "new");
    writeBytes(staged.temporary() / "b", "new");
    EXPECT_EQ(readBytes(folder / "a"), "old");
    staged.commit();
  }
  EXPECT_EQ(readBytes(folder / "a"), "new");
  EXPECT_EQ(readBytes(folder / "b"), "new");
  EXPECT_EQ(entriesOf(folder.path()), 3);
}

TEST(StagedFolder, WithoutACommitNothingIsLeft) {
  const TempFolder folder;
  {
    StagedFolder staged(folder / "new" / "out");
    writeBytes(staged.temporary() / "a", "half");
  }
  EXPECT_EQ(entriesOf(folder.path()), 0);
}

TEST(StagedFolder, AFileInTheWayIsNamed) {
  const TempFolder folder;
  writeBytes(folder / "out", "");
  EXPECT_EQ(test::messageOf<std::runtime_error>([&] {
              StagedFolder staged(folder / "out");
            }).find((folder / "out").string()),
            0u);
}

}  // namespace
}  // namespace sinew
