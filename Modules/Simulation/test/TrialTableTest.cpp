#include "sinew/Simulation/TrialTable.h"
#include "sinew/TestSupport/CommaLocale.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

NamedTrial trial(const std::string& name, bool completed, std::size_t frames, double largestAspectRatio = 1) {
  NamedTrial trial{name, {}};
  trial.report.completed = completed;
  trial.report.frames.resize(frames);
  trial.report.largestAspectRatio = largestAspectRatio;
  return trial;
}

TEST(TrialTable, HasALineForEachFrame) {
  const test::CommaLocale commas;
  NamedTrial one = trial("a \"b\",c", true, 1);
  one.report.frames[0] = {.time = 0.05,
                          .amount = 0.5,
                          .maxAspectRatio = 3.25,
                          .minVolumeRatio = 0.9,
                          .minDihedralDeg = 17,
                          .maxDihedralDeg = 146.5,
                          .energy = -1234.5,
                          .volume = 1e6,
                          .force = 12.5,
                          .residual = 1e-5,
                          .newtonSteps = 4,
                          .cgIterations = 99,
                          .converged = true,
                          .worst = {},
                          .flattest = {}};
  EXPECT_EQ(
      trialTable({one, trial("d", true, 1)}),
      "mesh,time_s,amount,max_aspect_ratio,min_volume_ratio,min_dihedral_deg,max_dihedral_deg,energy_uJ,"
      "volume_mm3,force_mN,residual,newton_steps,converged\n"
      "\"a \"\"b\"\",c\",0.05,0.5,3.25,0.9,17,146.5,-1234.5,1e+06,12.5,1e-05,4,1\n"
      "d,0,0,0,1,0,0,0,0,0,0,0,0\n");
}

TEST(TrialTable, TrialsThatStoppedAreWorst) {
  EXPECT_EQ(worstToBest({trial("a", true, 9, 4.2), trial("b", true, 9, 4.7), trial("c", false, 5, 4.1),
                         trial("d", false, 3, 4), trial("e", true, 9, 4.2)}),
            (std::vector<std::size_t>{3, 2, 1, 0, 4}));
}

TEST(TrialTable, RanksByTheWorstTetNotByItsGrowth) {
  NamedTrial good = trial("from 2 to 4", true, 9, 4), bad = trial("from 4 to 5", true, 9, 5);
  good.report.growth = 1;
  bad.report.growth = 0.25;
  EXPECT_EQ(worstToBest({good, bad}), (std::vector<std::size_t>{1, 0}));
}

}  // namespace
}  // namespace sinew
