#include "SolverMeshes.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

#include <clocale>
#include <csignal>
#include <locale>
#include <sys/resource.h>

namespace sinew {
namespace {

using test::readBytes;
using test::TempFolder;

/// `1.234,5` for 1234.5.
struct GermanNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

class GermanLocale {
 public:
  GermanLocale() : before_(std::locale::global(std::locale(std::locale(), new GermanNumbers))) {
    std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // where the machine has it
  }
  ~GermanLocale() {
    std::locale::global(before_);
    std::setlocale(LC_NUMERIC, "C");
  }

 private:
  std::locale before_;
};

class SolverFormats : public ::testing::TestWithParam<const char*> {
 protected:
  std::string write(const TissueMesh& mesh, const WriteMeshOptions& options = {}) {
    const auto file = folder_ / (std::string("a") + GetParam());
    writeMesh(mesh, file, options);
    return readBytes(file);
  }
  TempFolder folder_;
};

TEST_P(SolverFormats, TheSameMeshGivesTheSameBytes) {
  const TissueMesh mesh = test::twoHalves();
  const std::string bytes = write(mesh, {.quadratic = true});
  EXPECT_EQ(write(mesh, {.quadratic = true}), bytes);
  EXPECT_NE(write(mesh), bytes);
}

TEST_P(SolverFormats, NumbersDoNotFollowTheLocale) {
  const TissueMesh mesh = test::twoHalves();
  const std::string bytes = write(mesh, {.perMm = 2.5});
  const GermanLocale german;
  EXPECT_EQ(write(mesh, {.perMm = 2.5}), bytes);
}

TEST_P(SolverFormats, TissuesWithoutTetsAreLeftOut) {
  TissueMesh mesh = test::twoHalves();
  const std::string bytes = write(mesh);
  mesh.regions.push_back({99, "nothing"});
  EXPECT_EQ(write(mesh), bytes);
}

TEST_P(SolverFormats, EdgesBendAsTheMeshSays) {
  TissueMesh mesh = test::namedTets({"a"});
  const std::string straight = write(mesh, {.quadratic = true});
  mesh.curvedEdges = {{{0, 1}, {0.5, -0.1, 0}}};
  EXPECT_NE(write(mesh, {.quadratic = true}), straight);
}

TEST_P(SolverFormats, AFullDiskLeavesNothing) {
  const TissueMesh mesh = test::twoHalves();
  const std::size_t size = write(mesh).size();
  std::filesystem::remove(folder_ / (std::string("a") + GetParam()));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const std::size_t room : {std::size_t{10}, size / 2, size - 1}) {
    const rlimit full{.rlim_cur = room, .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    const std::string message = test::messageOf<std::runtime_error>([&] { write(mesh); });
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_NE(message.find("cannot be written (the file is incomplete; is the disk full?)"),
              std::string::npos)
        << message;
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  }
}

TEST_P(SolverFormats, AFolderThatIsNotThereIsNamed) {
  const auto file = folder_ / ("none/a" + std::string(GetParam()));
  const std::string message =
      test::messageOf<std::runtime_error>([&] { writeMesh(test::namedTets({"a"}), file); });
  EXPECT_TRUE(message.starts_with(file.string() + ": cannot be written (")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Files, SolverFormats, ::testing::Values(".msh", ".inp", ".feb", ".exo"),
                         [](const auto& test) { return std::string(test.param + 1); });

}  // namespace
}  // namespace sinew
