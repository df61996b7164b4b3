#include "sinew/Elasticity/HarmonicField.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

/// 0 at z = 0 of a bar and 1 at its length.
std::vector<double> endsOf(const ElasticBody& body, double length) {
  std::vector<double> given(body.nodeCount(), kWanted);
  for (std::size_t n = 0; n < given.size(); ++n) {
    if (body.rest[n].z() < 1e-9) given[n] = 0;
    if (body.rest[n].z() > length - 1e-9) given[n] = 1;
  }
  return given;
}

// Linear functions are harmonic, no flow leaves the sides, and linear tets hold them: the solver's tolerance.
TEST(HarmonicField, IsLinearAlongABar) {
  TetMesh mesh = test::barMesh({2, 3, 8}, 1);
  const ElasticBody body = elasticBody(mesh);
  const std::vector<double> field = harmonicField(body, endsOf(body, 8));
  for (std::size_t n = 0; n < field.size(); ++n) EXPECT_NEAR(field[n], body.rest[n].z() / 8, 1e-8);
}

TEST(HarmonicField, KeepsWhatIsGivenAndLiesBetween) {
  const ElasticBody body = elasticBody(test::spindleMesh({3, 3, 9}, 1));
  const std::vector<double> given = endsOf(body, 9), field = harmonicField(body, given);
  for (std::size_t n = 0; n < field.size(); ++n) {
    if (given[n] == 0 || given[n] == 1)
      EXPECT_EQ(field[n], given[n]);
    else
      EXPECT_TRUE(field[n] > 0 && field[n] < 1) << field[n];
  }
}

TEST(HarmonicField, IsZeroWhereNothingIsGiven) {
  const ElasticBody body = elasticBody(test::barMesh({1, 1, 2}, 1));
  const std::vector<double> field = harmonicField(body, std::vector<double>(body.nodeCount(), kWanted));
  EXPECT_EQ(field, std::vector<double>(body.nodeCount(), 0));
}

TEST(HarmonicField, RefusesAWrongNumberOfValues) {
  const ElasticBody body = elasticBody(test::barMesh({1, 1, 1}, 1));
  EXPECT_THROW(harmonicField(body, {0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
