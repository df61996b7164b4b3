#include "LegalNames.h"
#include "SolverMeshes.h"

#include <gtest/gtest.h>

#include <set>

namespace sinew {
namespace {

using Names = std::vector<std::string>;

Names legal(const Names& names, const NameRule& rule, const Names& taken = {}) {
  return legalNames(test::namedTets(names).regions, rule, taken);
}

constexpr NameRule kStrict{.maxBytes = 12, .refused = " /\"", .asciiOnly = true, .letterFirst = true};
constexpr NameRule kLoose{.maxBytes = 12, .refused = "\""};

TEST(LegalNames, LegalOnesStayUnchanged) {
  EXPECT_EQ(legal({"biceps", "fat-2", "M\u00fcller"}, kLoose), (Names{"biceps", "fat-2", "M\u00fcller"}));
}

TEST(LegalNames, RefusedCharactersAreReplaced) {
  EXPECT_EQ(legal({"a b/c", "M\u00fcll", "9 lives", "a\nb", "\xffx"}, kStrict),
            (Names{"a_b_c", "M_ll", "T_9_lives", "a_b", "T__x"}));
  EXPECT_EQ(legal({"a \"b\"", "\xffx"}, kLoose), (Names{"a _b_", "_x"}));
}

TEST(LegalNames, CutsNoCharacterInHalf) {
  EXPECT_EQ(legal({"elevenbytes\u00fc"}, kLoose), (Names{"elevenbytes"}));
  EXPECT_EQ(legal({"tenbytes..\u00fcx"}, kLoose), (Names{"tenbytes..\u00fc"}));
}

TEST(LegalNames, NoNameBecomesTheLabel) { EXPECT_EQ(legal({"", "x"}, kLoose), (Names{"Segment_1", "x"})); }

TEST(LegalNames, EqualNamesGetTheirLabels) {
  EXPECT_EQ(legal({"a", "A", "b"}, kLoose), (Names{"a_1", "A_2", "b"}));
  EXPECT_EQ(legal({"a", "a", "a_1"}, kLoose), (Names{"a_1_", "a_2", "a_1"}));
  EXPECT_EQ(legal({"twelve bytes one", "twelve bytes two"}, kLoose), (Names{"twelve byt_1", "twelve byt_2"}));
  EXPECT_EQ(legal({"Eall", "b"}, kLoose, {"eall"}), (Names{"Eall_1", "b"}));
}

TEST(LegalNames, HardNamesAreDistinctAndShort) {
  for (const NameRule& rule : {kStrict, kLoose}) {
    const Names names = legal(test::hardNames(), rule);
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size());
    for (const std::string& name : names) {
      EXPECT_LE(name.size(), rule.maxBytes);
      EXPECT_FALSE(name.empty());
    }
  }
}

TEST(LegalNames, CommentsAreOneLineOfText) {
  EXPECT_EQ(inComment("a\nb\rc\td \u00fc \xff"), "a b c d \u00fc ?");
}

}  // namespace
}  // namespace sinew
