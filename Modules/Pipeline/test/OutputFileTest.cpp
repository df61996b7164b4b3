#include "sinew/Pipeline/OutputFile.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <unistd.h>

namespace sinew {
namespace {

namespace fs = std::filesystem;

TEST(OutputFile, AppearsWhenCommitted) {
  const test::TempFolder folder;
  {
    OutputFile output(folder / "a.seg.nrrd");
    EXPECT_TRUE(output.temporary().string().ends_with("a.seg.nrrd"))
        << "writers choose the format by the ending";
    EXPECT_EQ(output.temporary().parent_path(), folder.path());
    test::writeBytes(output.temporary(), "new");
    EXPECT_FALSE(fs::exists(folder / "a.seg.nrrd"));
    output.commit();
  }
  EXPECT_EQ(test::readBytes(folder / "a.seg.nrrd"), "new");
  EXPECT_EQ(test::entriesOf(folder.path()), 1u);
}

TEST(OutputFile, LeavesNothingWithoutCommit) {
  const test::TempFolder folder;
  test::writeBytes(folder / "a", "old");
  {
    OutputFile output(folder / "a");
    test::writeBytes(output.temporary(), "half");
  }
  EXPECT_EQ(test::readBytes(folder / "a"), "old");
  EXPECT_EQ(test::entriesOf(folder.path()), 1u);
}

TEST(OutputFile, ASignalHandlerFindsEveryTemporary) {
  const test::TempFolder folder;
  const auto interrupted = [&] {
    OutputFile first(folder / "a"), second(folder / "b");
    test::writeBytes(first.temporary(), "half");
    test::writeBytes(second.temporary(), "half");
    removeTemporaryFiles();
    _exit(test::entriesOf(folder.path()) == 0 ? 0 : 1);
  };
  EXPECT_EXIT(interrupted(), testing::ExitedWithCode(0), "");
}

TEST(OutputFile, WriteTextFileNamesTheFileThatItCannotWrite) {
  const test::TempFolder folder;
  const std::string message =
      test::messageOf<std::runtime_error>([&] { writeTextFile(folder / "missing" / "a.json", "{}"); });
  EXPECT_NE(message.find("a.json"), std::string::npos) << message;
}

TEST(CheckOutput, ExistingFilesNeedForce) {
  const test::TempFolder folder;
  test::writeBytes(folder / "b.vtu", "old");
  EXPECT_NO_THROW(checkOutputFolder(folder.path(), {"a.vtu"}, false));
  EXPECT_NO_THROW(checkOutputFolder(folder.path(), {"a.vtu", "b.vtu"}, true));
  const std::string message = test::messageOf<std::runtime_error>([&] {
    checkOutputFolder(folder.path(), {"a.vtu", "b.vtu"}, false);
  });
  EXPECT_NE(message.find("b.vtu: exists"), std::string::npos) << message;
  EXPECT_NE(message.find("--force"), std::string::npos) << message;
}

TEST(CheckOutput, FoldersMayBeMissingButNotFiles) {
  const test::TempFolder folder;
  test::writeBytes(folder / "file", "");
  EXPECT_NO_THROW(checkOutputFolder(folder / "new" / "deep", {"a"}, false));
  EXPECT_EQ(test::entriesOf(folder.path()), 1u) << "checking leaves nothing";
  EXPECT_THROW(checkOutputFolder(folder / "file", {"a"}, false), std::runtime_error);
  EXPECT_THROW(checkOutputFolder(folder / "file" / "deep", {"a"}, false), std::runtime_error);
  EXPECT_THROW(checkOutputFile(folder.path(), true), std::runtime_error) << "a folder is no file";
  EXPECT_THROW(checkOutputFile("/dev/null", true), std::runtime_error) << "renaming onto it would replace it";
}

TEST(CheckOutput, UnwritableFoldersAreFoundBeforehand) {
  // Nobody can make files in /proc, not even root.
  EXPECT_THROW(checkOutputFile("/proc/a", false), std::runtime_error);
  EXPECT_THROW(checkOutputFolder("/proc/new/deep", {"a"}, false), std::runtime_error);
}

TEST(OutputFolder, IsTakenBackWhenNothingWasWritten) {
  const test::TempFolder folder;
  { const OutputFolder output(folder / "new" / "deep"); }
  EXPECT_EQ(test::entriesOf(folder.path()), 0u);
  {
    const OutputFolder output(folder / "new" / "deep");
    test::writeBytes(folder / "new" / "deep" / "a", "");
  }
  EXPECT_TRUE(fs::exists(folder / "new" / "deep" / "a"));
}

}  // namespace
}  // namespace sinew
