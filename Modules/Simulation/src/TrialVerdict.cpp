#include "TrialVerdict.h"

#include "TrialText.h"

#include <algorithm>

namespace sinew {
namespace {

struct TrialRow {
  std::string_view name, noun, before, after;  // the noun, and the unit around a number
  double amount, factor;                       // the usual amount, and what a number is multiplied with
  int digits;
};

/// In the order of Trial.
constexpr std::array<TrialRow, kTrials.size()> kRows{{
    {"contract", "contraction", "activation ", "", 1, 1, 2},
    {"compress", "compression", "", " %", 0.3, 100, 1},
    {"indent", "indentation", "", " % of the thickness", 0.3, 100, 1},
    {"stretch", "stretch", "", " %", 0.3, 100, 1},
    {"twist", "twist", "", " deg", 90, 1, 1},
}};

const TrialRow& row(Trial trial) { return kRows[static_cast<std::size_t>(trial)]; }

std::string text(std::string_view view) { return std::string(view); }

std::string spotText(const TrialSpot& spot) {
  return "tet " + std::to_string(spot.tet) + " near " + placeText(spot.place);
}

std::string stopText(const TrialRow& row, const TrialReport& report) {
  const TrialFrame& last = report.frames.back();
  return text(row.noun) + " stops at " + text(row.before) +
         fixedText(row.factor * *report.stoppedAt, row.digits) + text(row.after) +
         " (after t = " + fixedText(last.time, 2) + " s): forces find no balance beyond; " +
         spotText(last.flattest) + " is the flattest with J " + fixedText(last.minVolumeRatio, 2);
}

std::string growthText(const TrialReport& report) {
  const double start = report.frames.front().maxAspectRatio;
  return "worst aspect ratio " + fixedText(start, 2) + " -> " + fixedText(report.largestAspectRatio, 2) +
         " (" + (report.growth < 0 ? "" : "+") + fixedText(100 * report.growth, 0) + " %), least J " +
         fixedText(report.leastVolumeRatio, 2) + ", smallest dihedral " +
         fixedText(report.leastDihedralDeg, 1) + " deg";
}

std::string looseText(const TrialReport& report) {
  if (report.loosePieces == 0) return {};
  return "; " + std::to_string(report.looseTets) + " tets in " + std::to_string(report.loosePieces) +
         (report.loosePieces == 1 ? " piece" : " pieces") + " that nothing holds stood still";
}

}  // namespace

std::string_view trialName(Trial trial) { return row(trial).name; }
double usualAmount(Trial trial) { return row(trial).amount; }

void judge(const TrialOptions& options, TrialReport& report) {
  const TrialFrame& first = report.frames.front();
  report.leastVolumeRatio = first.minVolumeRatio;
  report.leastDihedralDeg = first.minDihedralDeg;
  report.largestDihedralDeg = first.maxDihedralDeg;
  for (const TrialFrame& frame : report.frames) {
    if (frame.maxAspectRatio > report.largestAspectRatio) {
      report.largestAspectRatio = frame.maxAspectRatio;
      report.worst = frame.worst;
    }
    report.leastVolumeRatio = std::min(report.leastVolumeRatio, frame.minVolumeRatio);
    report.leastDihedralDeg = std::min(report.leastDihedralDeg, frame.minDihedralDeg);
    report.largestDihedralDeg = std::max(report.largestDihedralDeg, frame.maxDihedralDeg);
  }
  report.growth = report.largestAspectRatio / first.maxAspectRatio - 1;
  const TrialRow& trial = row(options.trial);
  report.verdict = (report.completed ? text(trial.noun) + " completes" : stopText(trial, report)) +
                   (report.completed ? ": " : "; ") + growthText(report) + looseText(report);
}

}  // namespace sinew
