#include "Program.h"

#include <gtest/gtest.h>

#include <csignal>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;

/// Signals a run that is in the middle of meshing; what it leaves in its output folder.
std::vector<std::string> interrupt(int signal, int times) {
  const TempFolder folder;
  const fs::path arm = makePhantom(folder, "upper-arm");
  Program program({"mesh", arm.string(), "-o", (folder / "new" / "out").string(), "--verbose", "--tissue",
                   "humerus", "--edge-length", "0.7"});
  EXPECT_TRUE(program.waitFor(": lattice"));
  for (int time = 0; time < times; ++time) program.signal(signal);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exitCode, 130) << result.err;
  EXPECT_TRUE(result.err.ends_with("\nsinew: interrupted; no partial file is left\n")) << result.err;
  EXPECT_EQ(result.out, "");
  return namesIn(folder / "new" / "out");
}

TEST(Interrupt, LeavesNoPartialFile) {
  EXPECT_EQ(interrupt(SIGINT, 1), std::vector<std::string>{});
  EXPECT_EQ(interrupt(SIGTERM, 1), std::vector<std::string>{});
}

TEST(Interrupt, TheSecondOneEndsAtOnce) { EXPECT_EQ(interrupt(SIGINT, 2), std::vector<std::string>{}); }

}  // namespace
}  // namespace sinew::test
