// Numbers in files and on the command line have a point, whatever the user's language.
#include "Program.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace sinew::test {
namespace {

namespace fs = std::filesystem;

/// Makes programs started from now on German, as long as it lives.
class GermanEnvironment {
 public:
  GermanEnvironment() {
    const std::string folder = (locales_ / "de_DE.UTF-8").string();
    available_ = std::system(("localedef -i de_DE -f UTF-8 '" + folder + "' >/dev/null 2>&1").c_str()) == 0;
    setenv("LOCPATH", locales_.path().c_str(), 1);
    setenv("LC_ALL", "de_DE.UTF-8", 1);
  }
  ~GermanEnvironment() {
    unsetenv("LOCPATH");
    unsetenv("LC_ALL");
  }
  GermanEnvironment(const GermanEnvironment&) = delete;
  GermanEnvironment& operator=(const GermanEnvironment&) = delete;

  bool available() const { return available_; }

 private:
  TempFolder locales_;
  bool available_ = false;
};

/// What a run of meshing and converting leaves, but for the report with its times.
std::vector<std::string> outputs() {
  const TempFolder folder;
  const fs::path nested = makePhantom(folder, "nested", {"--spacing", "3.5"});
  EXPECT_EQ(run({"mesh", nested.string(), "-o", (folder / "m").string(), "--edge-length", "6.5", "--tissue",
                 "core", "--combined"})
                .exitCode,
            0);
  std::vector<std::string> bytes{readBytes(nested), readBytes(folder / "m" / "core.vtu"),
                                 readBytes(folder / "m" / "combined.vtu"),
                                 readBytes(folder / "m" / "scene.mrml")};
  const std::string mesh = (folder / "m" / "core.vtu").string();
  for (const char* name : {"a.vtk", "a.msh", "a.inp", "a.feb", "a.exo", "a.stl", "a.ply", "a.obj", "a.vtp"}) {
    EXPECT_EQ(run({"convert", mesh, (folder / name).string(), "--unit", "cm"}).exitCode, 0) << name;
    bytes.push_back(readBytes(folder / name));
  }
  for (const char* name : {"b.seg.nrrd", "b.nrrd", "b.nii", "b.mha"}) {
    EXPECT_EQ(run({"convert", nested.string(), (folder / name).string(), "--force"}).exitCode, 0) << name;
    bytes.push_back(readBytes(folder / name));
  }
  bytes.push_back(readBytes(folder / "b.ctbl"));
  return bytes;
}

TEST(Locale, GermanChangesNoByteOfAnyFile) {
  const std::vector<std::string> plain = outputs();
  const GermanEnvironment german;
  if (!german.available()) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8 here (Debian: locales)";
  const std::vector<std::string> changed = outputs();
  ASSERT_EQ(changed.size(), plain.size());
  for (std::size_t n = 0; n < plain.size(); ++n) EXPECT_TRUE(changed[n] == plain[n]) << "file " << n;
}

}  // namespace
}  // namespace sinew::test
