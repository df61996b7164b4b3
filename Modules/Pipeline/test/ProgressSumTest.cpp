#include "ProgressSum.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sinew {
namespace {

struct Call {
  std::string tissue, stage;
  double done;
};

TEST(ProgressSum, WeighsTissuesByTheirWork) {
  std::vector<Call> calls;
  const TissueProgress note = [&](const auto& tissue, const auto& stage, double done) {
    calls.push_back({tissue, stage, done});
  };
  ProgressSum sum({3, 1}, note);
  sum.report(0, "a", "half", 0.5);
  sum.report(1, "b", "done", 1);
  sum.report(0, "a", "done", 1);
  ASSERT_EQ(calls.size(), 3u);
  EXPECT_EQ(calls[0].done, 0.375);
  EXPECT_EQ(calls[1].done, 0.625);
  EXPECT_EQ(calls[2].done, 1);
  EXPECT_EQ(calls[1].tissue + calls[1].stage, "bdone");
}

TEST(ProgressSum, NeverGoesBack) {
  double last = 0;
  const TissueProgress note = [&](const auto&, const auto&, double done) { last = done; };
  ProgressSum sum({1}, note);
  sum.report(0, "a", "late", 0.8);
  sum.report(0, "a", "odd", 0.2);
  EXPECT_EQ(last, 0.8);
}

TEST(ProgressSum, WhatTheCallbackThrowsStopsEverybody) {
  const TissueProgress refuse = [](const auto&, const auto&, double) { throw std::domain_error("stop"); };
  ProgressSum sum({1, 1}, refuse);
  EXPECT_NO_THROW(sum.rethrow());
  EXPECT_THROW(sum.report(0, "a", "", 0), ProgressSum::Stopped);
  EXPECT_TRUE(sum.stopped());
  EXPECT_THROW(sum.report(1, "b", "", 0), ProgressSum::Stopped);
  EXPECT_THROW(sum.rethrow(), std::domain_error);
}

}  // namespace
}  // namespace sinew
