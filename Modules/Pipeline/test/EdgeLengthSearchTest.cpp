#include "EdgeLengthSearch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sinew {
namespace {

using Mesher = std::function<double(double edge)>;

/// Searches with a formula in the mesher's place; all trials.
std::vector<SizeTrial> search(const Mesher& tets, double firstEdge, std::int64_t wanted) {
  std::vector<SizeTrial> trials;
  for (std::optional<double> edge = firstEdge; edge; edge = nextEdgeLength(trials, wanted))
    trials.push_back({*edge, std::llround(tets(*edge))});
  return trials;
}

/// 30 tets per square of the surface of a ball of radius r and 12 / 512 per cube of its volume, as with cubes
/// of up to eight edge lengths inside.
double ballTets(double r, double edge) {
  return 30 * 4 * M_PI * std::pow(r / edge, 2) + 12. / 512 * 4 * M_PI / 3 * std::pow(r / edge, 3);
}

TEST(EdgeLengthSearch, FindsSmoothCountsInAFewTrials) {
  for (const std::int64_t wanted : {1000, 50'000, 3'000'000})
    for (const double guess : {0.3, 0.8, 1.0, 1.5, 4.0}) {
      const Mesher tets = [](double edge) { return ballTets(20, edge); };
      const double right = 20 * std::sqrt(30 * 4 * M_PI / static_cast<double>(wanted));
      const std::vector<SizeTrial> trials = search(tets, guess * right, wanted);
      EXPECT_LE(trials.size(), 4u) << wanted << " from " << guess;
      EXPECT_TRUE(hasTets(trials.back().tets, wanted)) << wanted << " from " << guess;
    }
}

TEST(EdgeLengthSearch, AGoodFirstTrialIsEnough) {
  EXPECT_FALSE(nextEdgeLength({{1, 1099}}, 1000).has_value());
  EXPECT_FALSE(nextEdgeLength({{1, 901}}, 1000).has_value());
  EXPECT_GT(nextEdgeLength({{1, 1101}}, 1000), 1);
  EXPECT_LT(nextEdgeLength({{1, 899}}, 1000), 1);
}

TEST(EdgeLengthSearch, FindsTheNumberBesideAJump) {
  // Where the whole surface gets finer cubes at once, the number jumps by four.
  const Mesher tets = [](double edge) { return (edge < 1.3 ? 4 : 1) * 1e4 / (edge * edge); };
  for (const std::int64_t wanted : {5000, 30'000, 100'000}) {
    const std::vector<SizeTrial> trials = search(tets, 1, wanted);
    EXPECT_TRUE(hasTets(trials[bestTrial(trials, wanted)].tets, wanted)) << wanted;
  }
}

TEST(EdgeLengthSearch, GoesOnBeyondAJumpUpwards) {
  // Measured on a cartilage: from 2.2 mm on the whole surface gets the cubes that a part of it asks for.
  const Mesher tets = [](double edge) { return (edge < 2.15 ? 5.2e5 : 1.75e6) / (edge * edge); };
  const std::vector<SizeTrial> trials = search(tets, 1.6, 100'000);
  EXPECT_TRUE(hasTets(trials[bestTrial(trials, 100'000)].tets, 100'000));
}

TEST(EdgeLengthSearch, EndsWithTheNearestWhereTheNumberJumpsOverIt) {
  const Mesher tets = [](double edge) { return (edge < 1.3 ? 4 : 1) * 1e4 / (edge * edge); };
  const std::vector<SizeTrial> trials = search(tets, 1, 12'000);  // 5,917 on one side, 23,669 on the other
  EXPECT_LE(trials.size(), std::size_t{kMostSizeTrials});
  EXPECT_NEAR(trials[bestTrial(trials, 12'000)].edge, 1.3, 0.1);
}

TEST(EdgeLengthSearch, ComesBackFromAnEmptyMesh) {
  const Mesher tets = [](double edge) { return edge > 5 ? 0 : ballTets(4, edge); };
  const std::vector<SizeTrial> trials = search(tets, 8, 2000);
  EXPECT_TRUE(hasTets(trials.back().tets, 2000)) << trials.back().tets;
}

TEST(EdgeLengthSearch, EndsWhenNothingHelps) {
  EXPECT_EQ(search([](double) { return 7; }, 1, 1000).size(), std::size_t{kMostSizeTrials});
}

TEST(EdgeLengthSearch, TheFirstOfEquallyGoodTrialsIsBest) {
  const std::vector<SizeTrial> trials{{1, 4000}, {2, 250}, {3, 500}, {4, 2000}};
  EXPECT_EQ(bestTrial(trials, 1000), 2u);
}

TEST(EdgeLengthSearch, BeginsWithTheSurfaceOrTheVolume) {
  // Twice as fine for four times the tets of a surface, for eight times those of a volume.
  EXPECT_NEAR(firstEdgeLength(100, 1e9, 40'000) / firstEdgeLength(100, 1e9, 10'000), 0.5, 1e-12);
  EXPECT_NEAR(firstEdgeLength(1e9, 100, 8000) / firstEdgeLength(1e9, 100, 1000), 0.5, 1e-12);
}

}  // namespace
}  // namespace sinew
