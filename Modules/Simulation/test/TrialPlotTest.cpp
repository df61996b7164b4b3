#include "sinew/Simulation/TrialPlot.h"
#include "sinew/TestSupport/CommaLocale.h"

#include <gtest/gtest.h>

#include <limits>

namespace sinew {
namespace {

NamedTrial bump(const std::string& name, double height, bool completed = true) {
  NamedTrial trial{name, {}};
  trial.report.completed = completed;
  for (int i = 0; i <= 10; ++i) {
    const double amount = i < 5 ? 0.2 * i : 0.2 * (10 - i);
    trial.report.frames.push_back({.time = 0.2 * i,
                                   .amount = amount,
                                   .maxAspectRatio = 3 + height * amount,
                                   .minVolumeRatio = 1 - 0.5 * amount,
                                   .minDihedralDeg = 20 - 4.5 * amount,
                                   .maxDihedralDeg = 140,
                                   .energy = -500 * amount,
                                   .volume = 1000 + amount,
                                   .residual = 0,
                                   .newtonSteps = 1,
                                   .cgIterations = 1,
                                   .converged = true,
                                   .worst = {},
                                   .flattest = {}});
  }
  return trial;
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(TrialPlot, HasALineForEachMeshInEachChart) {
  const std::string one = trialPlot({bump("a", 2)}, Trial::Contract, "biceps <1>");
  EXPECT_EQ(countOf(one, "<polyline"), 6u);
  EXPECT_EQ(countOf(one, "biceps &lt;1&gt;"), 1u);
  EXPECT_EQ(countOf(one, ">a</text>"), 0u) << "one needs no legend";
  for (const char* title : {">activation<", ">largest aspect ratio<", ">least volume ratio J<",
                            ">smallest dihedral angle, deg<", ">energy, mJ<", ">volume, % of that at rest<"})
    EXPECT_EQ(countOf(one, title), 1u) << title;

  const std::string two = trialPlot({bump("a", 2), bump("b", 5, false)}, Trial::Twist, "t");
  EXPECT_EQ(countOf(two, "<polyline"), 12u);
  EXPECT_EQ(countOf(two, ">a</text>"), 1u);
  EXPECT_EQ(countOf(two, ">b (stopped early)</text>"), 1u);
  EXPECT_EQ(countOf(two, "<path"), 6u) << "a cross where b stops";
}

TEST(TrialPlot, IsWellFormedAndTheSameInEveryLocale) {
  const auto plot = [] { return trialPlot({bump("a", 2), bump("b&c", 900)}, Trial::Indent, "t"); };
  const std::string here = plot();
  EXPECT_EQ(countOf(here, "<text"), countOf(here, "</text>"));
  EXPECT_TRUE(here.ends_with("</svg>\n"));
  const test::CommaLocale commas;
  EXPECT_EQ(plot(), here);
}

TEST(TrialPlot, LargeAspectRatiosStandOnALogarithmicScale) {
  const std::string plot = trialPlot({bump("a", 2), bump("b", 900)}, Trial::Contract, "t");
  for (const char* mark : {">10<", ">1000<"}) EXPECT_EQ(countOf(plot, mark), 1u) << mark;
}

TEST(TrialPlot, WhatIsNotFiniteIsLeftOut) {
  NamedTrial flat = bump("a", 2);
  flat.report.frames[4].maxAspectRatio = std::numeric_limits<double>::infinity();
  flat.report.frames[5].energy = std::numeric_limits<double>::quiet_NaN();
  const std::string plot = trialPlot({flat}, Trial::Contract, "t");
  EXPECT_EQ(countOf(plot, "inf"), 0u);
  EXPECT_EQ(countOf(plot, "nan"), 0u);
}

TEST(TrialPlot, ATrialThatEndedAtItsFirstFrameHasOneToo) {
  NamedTrial short_ = bump("a", 2, false);
  short_.report.frames.resize(1);
  EXPECT_EQ(countOf(trialPlot({short_}, Trial::Contract, "t"), "<polyline"), 6u);
}

}  // namespace
}  // namespace sinew
