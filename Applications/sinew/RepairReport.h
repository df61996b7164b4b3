#pragma once

#include "sinew/Repair/RepairSegmentation.h"

#include <ostream>
#include <string>

namespace sinew {

/// What belongs to a run of `sinew repair` beside its result.
struct RepairRun {
  std::string input, script, output;
  bool check = false;
  double seconds = 0;
};

/// The machine-readable result; the README lists its fields.
std::string toJson(const RepairRun& run, const RepairResult& result);

/// Tables of operations and saved tissues, and messages, for people.
void printResult(std::ostream& stream, const RepairRun& run, const RepairResult& result);

}  // namespace sinew
