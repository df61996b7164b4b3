#include "FailureSummary.h"

#include "TextTable.h"

namespace sinew {

std::string failureSummary(const std::vector<TissueReport>& reports) {
  constexpr int kNamed = 5;
  std::string names;
  int count = 0;
  for (const TissueReport& report : reports) {
    if (report.status != TissueStatus::Failed) continue;
    if (++count <= kNamed) names += (names.empty() ? "" : ", ") + printable(report.name);
  }
  if (count == 0) return {};
  return std::to_string(count) + " of " + std::to_string(reports.size()) + " tissues failed: " + names +
         (count > kNamed ? ", ..." : "");
}

}  // namespace sinew
