#include "sinew/Simulation/TrialTable.h"

#include "Numbers.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace sinew {
namespace {

struct Column {
  const char* title;
  double (*value)(const TrialFrame&);
};

constexpr std::array kColumns{
    Column{"time_s", [](const TrialFrame& frame) { return frame.time; }},
    Column{"amount", [](const TrialFrame& frame) { return frame.amount; }},
    Column{"max_aspect_ratio", [](const TrialFrame& frame) { return frame.maxAspectRatio; }},
    Column{"min_volume_ratio", [](const TrialFrame& frame) { return frame.minVolumeRatio; }},
    Column{"min_dihedral_deg", [](const TrialFrame& frame) { return frame.minDihedralDeg; }},
    Column{"max_dihedral_deg", [](const TrialFrame& frame) { return frame.maxDihedralDeg; }},
    Column{"energy_uJ", [](const TrialFrame& frame) { return frame.energy; }},
    Column{"volume_mm3", [](const TrialFrame& frame) { return frame.volume; }},
    Column{"force_mN", [](const TrialFrame& frame) { return frame.force; }},
    Column{"residual", [](const TrialFrame& frame) { return frame.residual; }},
    Column{"newton_steps", [](const TrialFrame& frame) { return double(frame.newtonSteps); }},
    Column{"converged", [](const TrialFrame& frame) { return double(frame.converged); }},
};

/// In quotes where a comma, a quote or a line's end asks for them.
std::string csvText(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string trialTable(const std::vector<NamedTrial>& trials) {
  std::string table = "mesh";
  for (const Column& column : kColumns) table += std::string(",") + column.title;
  table += '\n';
  for (const NamedTrial& trial : trials)
    for (const TrialFrame& frame : trial.report.frames) {
      table += csvText(trial.name);
      for (const Column& column : kColumns) table += ',' + exactText(column.value(frame));
      table += '\n';
    }
  return table;
}

std::vector<std::size_t> worstToBest(const std::vector<NamedTrial>& trials) {
  std::vector<std::size_t> order(trials.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto worse = [&](std::size_t a, std::size_t b) {
    const TrialReport &x = trials[a].report, &y = trials[b].report;
    if (x.completed != y.completed) return !x.completed;
    if (!x.completed && x.frames.size() != y.frames.size()) return x.frames.size() < y.frames.size();
    return x.largestAspectRatio > y.largestAspectRatio;
  };
  std::ranges::stable_sort(order, worse);
  return order;
}

}  // namespace sinew
