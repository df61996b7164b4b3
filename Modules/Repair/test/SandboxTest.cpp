#include "ScriptRunner.h"

#include <gtest/gtest.h>

#include <fstream>

namespace sinew {
namespace {

using test::errorOf;
using test::printed;
using Lines = std::vector<std::string>;

const RepairOptions kSmall{.check = true, .limits = {.instructions = 2'000'000, .scriptBytes = 4'000'000}};

TEST(Sandbox, AnEndlessLoopIsStopped) {
  EXPECT_EQ(errorOf("local n = 0\n\nwhile true do n = n + 1 end", kSmall),
            "script.lua:3: the script was stopped after 2 million instructions; is there an endless loop?");
  EXPECT_EQ(errorOf("local function f()\n  return f()\nend\nf()", kSmall),
            "script.lua:2: the script was stopped after 2 million instructions; is there an endless loop?");
}

TEST(Sandbox, LoopsInsideOfLibraryFunctionsCount) {
  const std::string end = "the script was stopped after 2 million instructions; is there an endless loop?";
  EXPECT_EQ(errorOf("local t = {}\nfor i = 1, 20000 do table.insert(t, 1, i) end", kSmall),
            "script.lua:2: " + end);
  EXPECT_EQ(errorOf("local s = string.rep('x', 1000000)\nwhile true do local u = s:upper() end", kSmall),
            "script.lua:2: " + end);
}

TEST(Sandbox, GoingThroughLongTextsCounts) {
  const std::string end = "the script was stopped after 2 million instructions; is there an endless loop?";
  EXPECT_EQ(
      errorOf("local a = string.rep('x', 1000000)\nlocal b = a .. 'y'\nwhile true do local c = a < b end",
              kSmall),
      "script.lua:3: " + end);
}

TEST(Sandbox, OneCallTakesSoMuchText) {
  EXPECT_EQ(
      errorOf("local s = string.rep('x', 1000000)\nlocal t = {}\nfor i = 1, 100 do t[i] = s end\nprint(t)"),
      "script.lua:4: more than 16 MB of texts in one call");
}

TEST(Sandbox, ATableWithAFarBorderDoesNotLoopForever) {
  // Powers of two lead the search for the end of the list, #t, to 2^62.
  EXPECT_EQ(errorOf("local t = {[3]=1, [9]=1}\nlocal i = 1\nwhile i > 0 do t[i] = 1; i = i * 2 end\n"
                    "assert(#t > 1e9, #t)\ntable.insert(t, 1, 0)"),
            "script.lua:5: the table is too long");
}

TEST(Sandbox, AMemoryBombIsStopped) {
  const std::string end = "the texts and tables of the script take more than 4 MB";
  EXPECT_EQ(errorOf("local s = 'x'\nwhile true do s = s .. s end", kSmall), "script.lua:2: " + end);
  EXPECT_EQ(errorOf("local t = {}\n\nfor i = 1, 1e9 do t[i] = i end", kSmall), "script.lua:3: " + end);
  EXPECT_EQ(errorOf("local s = string.rep('x', 1e9)", kSmall), "script.lua:1: " + end);
}

TEST(Sandbox, RecursionWithoutEndIsStopped) {
  const std::string error = errorOf("local function f() return 1 + f() end\nf()");
  EXPECT_TRUE(error.starts_with("script.lua:1: stack overflow")) << error;
  EXPECT_EQ(error.find('\n'), error.npos);
}

TEST(Sandbox, SyntaxErrorsCarryTheirLine) {
  EXPECT_EQ(errorOf("local a = 1\nlocal b = = 2"), "script.lua:2: unexpected symbol near '='");
  EXPECT_EQ(errorOf("for i = 1, 3 do\n  print(i)"),
            "script.lua:2: 'end' expected (to close 'for' at line 1) near <eof>");
  EXPECT_EQ(errorOf("x ="), "script.lua:1: unexpected symbol near <eof>");
}

TEST(Sandbox, TheNameOfTheScriptIsInFrontWhateverItIs) {
  const std::string name(100, 'n');
  const std::string error = errorOf("\nio.open('x')", {.scriptName = name, .check = true});
  EXPECT_TRUE(error.starts_with("...nnnn")) << error;
  EXPECT_NE(error.find("nnn:2: a repair script"), error.npos) << error;
}

TEST(Sandbox, FilesAndTheSystemAreOutOfReach) {
  EXPECT_EQ(errorOf("local f = io.open('/etc/passwd')"),
            "script.lua:1: a repair script cannot open files (io)");
  EXPECT_EQ(errorOf("\nos.execute('ls')"), "script.lua:2: a repair script cannot reach the system (os)");
  EXPECT_EQ(errorOf("dofile 'other.lua'"), "script.lua:1: a repair script cannot open files (dofile)");
  EXPECT_EQ(errorOf("load('return 1')()"), "script.lua:1: a repair script cannot load code (load)");
  EXPECT_EQ(errorOf("local m = require 'socket'"),
            "script.lua:1: a repair script cannot load modules (require)");
  for (const char* name : {"debug", "package", "loadfile", "loadstring", "coroutine", "pcall", "xpcall",
                           "next", "getmetatable", "setmetatable", "collectgarbage", "utf8"}) {
    const std::string error = errorOf(std::string("local x = ") + name);
    EXPECT_TRUE(error.starts_with("script.lua:1: a repair script")) << name << ": " << error;
  }
}

TEST(Sandbox, TextPatternsAreRefused) {
  const std::string reason =
      "a repair script has no text patterns (string.find, match, gmatch, gsub); tissues \"left*\" finds by "
      "name";
  EXPECT_EQ(errorOf("string.find('aaaa', 'a-a-b')"), "script.lua:1: " + reason);
  EXPECT_EQ(errorOf("local s = ('aaaa'):gsub('a', 'b')"), "script.lua:1: " + reason) << "also as a method";
  EXPECT_EQ(errorOf("local d = string.dump(print)"), "script.lua:1: a repair script has no string.dump");
}

TEST(Sandbox, CompiledLuaIsRefused) {
  EXPECT_EQ(errorOf("\x1bLuaT"), "script.lua: this is compiled Lua; a repair script is text");
}

TEST(Sandbox, AMarkOfUtf8InFrontIsNoError) { EXPECT_EQ(printed("\xef\xbb\xbfprint(1)"), Lines{"1"}); }

TEST(Sandbox, UnknownNamesAreToldTheNearest) {
  EXPECT_EQ(errorOf("\nlocal s = spere{}"),
            "script.lua:2: unknown name 'spere'; the nearest are 'sphere', 'save', 'scale'");
}

TEST(Sandbox, GlobalsOfTheScriptAreItsOwn) {
  EXPECT_EQ(printed("x = 4\nfunction double(n) return 2 * n end\nprint(double(x))"), Lines{"8"});
}

TEST(Sandbox, PairsGoesInTheOrderOfTheKeys) {
  EXPECT_EQ(printed("local t = {b=1, a=2, [3]=3, [-1]=4, [2.5]=5, [true]=6, c=7, aa=8}\n"
                    "local s = ''\nfor k, v in pairs(t) do s = s .. tostring(k) .. v .. ' ' end\nprint(s)"),
            Lines{"-14 2.55 33 a2 aa8 b1 c7 true6 "});
  EXPECT_EQ(
      printed(
          "local t = {}\nfor i = 100, 1, -1 do t['k' .. 1000 + i] = i end\n"
          "local last, n = '', 0\nfor k in pairs(t) do assert(last < k); last = k; n = n + 1 end\nprint(n)"),
      Lines{"100"});
  EXPECT_EQ(errorOf("for k in pairs({[print]=1}) do end"),
            "script.lua:1: pairs: a function as a key has no place in an order");
}

TEST(Sandbox, ListsAreSorted) {
  EXPECT_EQ(printed("local t = {5, 2, 8, 1, 9, 3}\ntable.sort(t)\nprint(t)\n"
                    "table.sort(t, function(a, b) return a > b end)\nprint(t)\ntable.sort({})"),
            (Lines{"{1, 2, 3, 5, 8, 9}", "{9, 8, 5, 3, 2, 1}"}));
  EXPECT_EQ(printed("local t = {}\nfor i = 1, 1000 do t[i] = i * 7919 % 1009 end\ntable.sort(t)\n"
                    "for i = 2, #t do assert(t[i - 1] < t[i]) end\nprint(#t)"),
            Lines{"1000"});
  EXPECT_EQ(errorOf("table.sort({1, 'x'})"), "script.lua:1: attempt to compare number with string");
  EXPECT_EQ(printed("local t = {1, 2, 3, 4, 5, 6, 7}\ntable.sort(t, function() return true end)\nprint(#t)"),
            Lines{"7"})
      << "an order that is none ends all the same";
}

TEST(Sandbox, RandomNumbersAreTheSameEveryTime) {
  const std::string script = "print(math.random(1000000), math.random(), {} ~= nil)";
  EXPECT_EQ(printed(script), printed(script));
  EXPECT_EQ(errorOf("math.randomseed(os)").find("os"),
            std::string("script.lua:1: a repair script cannot reach the system (").size());
  EXPECT_EQ(errorOf("math.randomseed(5)"),
            "script.lua:1: a repair script has no math.randomseed: math.random gives the same numbers in "
            "every run");
}

TEST(Sandbox, NothingShowsAnAddress) {
  EXPECT_EQ(printed("print(print, {}, tostring(print), {1, {2, name='x'}})"),
            Lines{"function {} function {1, {2, name=x}}"});
  EXPECT_EQ(errorOf("print(string.format('%-5p', 'x'))"),
            "script.lua:1: string.format: there is no %p in a repair script");
  EXPECT_EQ(errorOf("print(string.format('%s', {}))"),
            "script.lua:1: string.format: value 1 is a table; use tostring");
  EXPECT_EQ(printed("print(string.format('%.2f %s %d%%', 1.234, 'x', 7))"), Lines{"1.23 x 7%"});
}

TEST(Sandbox, ErrorsOfTheScriptItselfAreToldWithTheirLine) {
  EXPECT_EQ(errorOf("\nerror('too thin')"), "script.lua:2: too thin");
  EXPECT_EQ(errorOf("\n\nerror('a\\nb', 0)"), "script.lua:3: a b");
  EXPECT_EQ(errorOf("error({})"), "script.lua:1: error() without a text");
  EXPECT_EQ(errorOf("assert(1 > 2, 'no')"), "script.lua:1: no");
  EXPECT_EQ(errorOf("local t = nil\nprint(t.x)"), "script.lua:2: attempt to index a nil value (local 't')");
}

TEST(Sandbox, TypesAreNamedAsAPersonWould) {
  EXPECT_EQ(printed("print(type(tissue 'biceps'), type(1), tissue 'biceps')"),
            Lines{"shape number tissue 'biceps'"});
  EXPECT_EQ(errorOf("local s = tissue 'biceps' .. 'x'"),
            "script.lua:1: attempt to concatenate a shape value");
  EXPECT_EQ(errorOf("local a, b = tissue 'biceps', tissue 'humerus'\nprint(a < b)"),
            "script.lua:2: attempt to compare two shape values");
}

TEST(Sandbox, TablesInsideOfThemselvesAreRefused) {
  EXPECT_EQ(errorOf("local t = {}\nt.t = t\nprint(t)"),
            "script.lua:3: tables inside of tables, too many or without an end");
}

TEST(Sandbox, AnExceptionOfTheProgressEndsTheScript) {
  struct Interrupted {};
  int calls = 0;
  const RepairOptions options{.check = true, .progress = [&](int, const std::string&, double) {
                                if (++calls == 3) throw Interrupted{};
                              }};
  EXPECT_THROW(repairSegmentation(test::smallArm(), "while true do end", options), Interrupted);
  EXPECT_EQ(calls, 3);
  calls = 0;
  EXPECT_THROW(repairSegmentation(test::smallArm(), "for i = 1, 9 do local t = tissue 'biceps' end", options),
               Interrupted);
}

}  // namespace
}  // namespace sinew
