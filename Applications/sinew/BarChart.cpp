#include "BarChart.h"

#include "TextTable.h"

#include <algorithm>

namespace sinew {

void BarChart::print(std::ostream& stream) const {
  constexpr std::int64_t kLongest = 40;
  const auto full = [](const Bar& bar) { return bar.count > 0; };
  const auto first = std::ranges::find_if(bars, full);
  if (first == bars.end()) return;
  const auto last = std::find_if(bars.rbegin(), bars.rend(), full).base();
  const std::int64_t most = std::ranges::max(bars, {}, &Bar::count).count;
  TextTable table({{title}, {"count"}, {"", Align::Left}});
  for (auto bar = first; bar != last; ++bar) {
    const std::int64_t marks = (bar->count * kLongest + most - 1) / most;
    table.add({bar->name, grouped(bar->count), std::string(static_cast<std::size_t>(marks), '#')});
  }
  table.print(stream);
}

}  // namespace sinew
