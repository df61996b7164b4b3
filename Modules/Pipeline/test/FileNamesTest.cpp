#include "sinew/Pipeline/FileNames.h"

#include <gtest/gtest.h>

#include <set>

namespace sinew {
namespace {

struct Entry {
  std::string name;
  std::int32_t label = 1;
  int layer = 0;
};

std::vector<std::string> stemsOf(const std::vector<Entry>& entries) {
  std::vector<Tissue> tissues;
  for (const Entry& entry : entries) {
    Tissue tissue;
    tissue.name = entry.name;
    tissue.label = entry.label;
    tissue.layer = entry.layer;
    tissues.push_back(tissue);
  }
  return tissueFileStems(tissues);
}

using Stems = std::vector<std::string>;

TEST(FileNames, OrdinaryNamesKeepTheirLetters) {
  EXPECT_EQ(stemsOf({{"biceps"}, {"Vastus medialis", 2}, {"os-coxae.left", 3}, {"fémur", 4}}),
            (Stems{"biceps", "Vastus_medialis", "os-coxae.left", "fémur"}));
}

TEST(FileNames, NothingLeavesTheFolder) {
  EXPECT_EQ(stemsOf({{"../../etc/passwd"}, {"/root", 2}, {"a\\b", 3}, {"..", 4}, {".hidden", 5}, {"-rf", 6}}),
            (Stems{"_._.._etc_passwd", "_root", "a_b", "__", "_hidden", "_rf"}));
}

TEST(FileNames, EveryNameHasLettersThatAllSystemsTake) {
  EXPECT_EQ(stemsOf({{""}, {"a:b*c?d\"e<f>g|h\n\x7f", 2}, {"NUL", 3}, {"com1.left", 4}, {"\xff\xc3", 5}}),
            (Stems{"_tissue", "a_b_c_d_e_f_g_h__", "NUL_tissue", "com1.left_tissue", "__"}));
}

TEST(FileNames, SharedNamesGetTheLabelAndSharedLabelsTheLayer) {
  EXPECT_EQ(stemsOf({{"bone", 1}, {"bone", 2}, {"Muscle", 3}, {"muscle", 4}}),
            (Stems{"bone_1", "bone_2", "Muscle_3", "muscle_4"}));
  EXPECT_EQ(stemsOf({{"bone", 1, 0}, {"bone", 1, 1}, {"bone", 2, 1}}),
            (Stems{"bone_1_layer0", "bone_1_layer1", "bone_2"}));
}

TEST(FileNames, M6_CaseIsNoDifferenceInAnyScript) {
  EXPECT_EQ(stemsOf({{"MÜLLER", 1}, {"müller", 2}, {"Ухо", 3}, {"ухо", 4}, {"œil", 5}, {"Œil", 6}}),
            (Stems{"MÜLLER_1", "müller_2", "Ухо_3", "ухо_4", "œil_5", "Œil_6"}));
}

TEST(FileNames, M6_NamesThatDifferOnlyInWhatIsRefusedOrCutStayApart) {
  const std::string longName(200, 'x');
  const Stems stems = stemsOf({{"a b", 1},
                               {"a/b", 2},
                               {"a_b", 3},
                               {"", 4},
                               {"_tissue", 5},
                               {longName + "1", 6},
                               {longName + "2", 7},
                               {"\"a\"", 8},
                               {"<a>", 9}});
  EXPECT_EQ(std::set<std::string>(stems.begin(), stems.end()).size(), stems.size());
  for (const std::string& stem : stems) EXPECT_LT(stem.size(), 200u);
}

TEST(FileNames, AnAppendedLabelNeverMeetsAnotherName) {
  const Stems stems = stemsOf({{"bone", 1}, {"bone_1", 5}, {"bone", 2}, {"bone_2", 6}, {"bone_2_", 7}});
  EXPECT_EQ(std::set<std::string>(stems.begin(), stems.end()).size(), stems.size());
  EXPECT_EQ(stems[1], "bone_1");
}

TEST(FileNames, LongNamesAreCutBetweenCharacters) {
  std::string name = "a";
  for (int i = 0; i < 200; ++i) name += "é";
  const std::string stem = stemsOf({{name}}).front();
  EXPECT_LT(stem.size(), 200u);
  EXPECT_EQ(stem.size() % 2, 1u) << "half a character at the end";
}

TEST(FileNames, AFreeStemDiffersFromAllWithoutRegardToCase) {
  EXPECT_EQ(freeFileStem("combined", {"femur"}), "combined");
  EXPECT_EQ(freeFileStem("combined", {"Combined", "combined_", "femur"}), "combined__");
}

}  // namespace
}  // namespace sinew
