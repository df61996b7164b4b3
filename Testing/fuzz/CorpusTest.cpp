#include "Targets.h"
#include "sinew/TestSupport/Files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>

/// Every input of the corpus through its target, without a fuzzer. A file's name says what must come of it:
/// `taken-...` or `refused-...`.
namespace sinew::fuzz {

void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

namespace {

namespace fs = std::filesystem;

class FuzzCorpus : public testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, EveryInputIsTakenOrRefusedAsItsNameSays) {
  std::set<std::string> outcomes;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(SINEW_FUZZ_CORPUS) / GetParam().name)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const std::string outcome = GetParam().run(test::readBytes(entry.path())) ? "taken" : "refused";
    EXPECT_EQ(name.substr(0, name.find('-')), outcome);
    outcomes.insert(outcome);
  }
  EXPECT_EQ(outcomes, (std::set<std::string>{"refused", "taken"})) << "the corpus must show both";
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& info) {
                           std::string name(info.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace sinew::fuzz
